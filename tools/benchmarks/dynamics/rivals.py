"""The compared integrators of Eq. 12, all at the thesis's tolerances and with the same symbols."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import casadi
import numpy as np
from scipy.integrate import solve_ivp

from continuum.arrays import Array
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.compiled.machine_code import address_of
from continuum.dynamics.compiled.symbolic_balance import SymbolicBalance
from continuum.dynamics.integration.esdirk_tableau import fourth_order, third_order
from continuum.dynamics.integration.scipy_bdf import simulate_bdf
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import parameter_vector
from tools.benchmarks.dynamics.lean_rates import lean_rates
from tools.benchmarks.dynamics.scene import Scene

LIMITS = Tolerances()


@dataclass(frozen=True)
class Rival:
    """One way to integrate.

    Attributes:
        name: name in the table.
        run: function that returns joint angles at the output times, (n_times, n) [rad].
        with_derivatives: the same with sensitivities to ten parameters; None if it has none.
    """

    name: str
    run: Callable[[], Array]
    with_derivatives: Callable[[], Array] | None = None


BASELINE = "SciPy BDF, NumPy written for this case"
OURS = "ESDIRK"
"""Beginning of the names of the library's integrators."""
SUNDAE = "CVODE by scikit-sundae, numba"


def rivals(scene: Scene) -> Iterator[Rival]:
    """Yield all installed integrators, the baseline first, the library's default last."""
    rates = lean_rates(scene.model.parameters)
    yield Rival(BASELINE, lambda: plain_bdf(scene, rates))
    yield Rival(
        "SciPy BDF, the library's terms in NumPy", lambda: simulate_bdf(scene.model, scene.start, scene.times).theta
    )
    compiled = CompiledEquations(scene.model)
    yield Rival(
        "SciPy BDF, compiled equations, exact Jacobian",
        lambda: simulate_bdf(scene.model, scene.start, scene.times, equations=compiled).theta,
    )
    yield casadi_cvodes(scene)
    sundae = sundae_cvode(scene, compiled)
    if sundae is not None:
        yield sundae
    for name, tableau in (("ESDIRK4", fourth_order()), ("ESDIRK3, the library's default", third_order())):
        simulator = Simulator(scene.model, LIMITS, tableau)
        yield Rival(
            name,
            lambda simulator=simulator: simulator.run(scene.start, scene.times).theta,  # type: ignore[misc]
            lambda simulator=simulator: (  # type: ignore[misc]
                simulator.run(scene.start, scene.times, free=scene.directions).theta
            ),
        )


def plain_bdf(scene: Scene, rates: Callable[[float, Array], Array]) -> Array:
    """Run SciPy's BDF in its usual form, with a Jacobian by differences; return joint angles (n_times, n) [rad]."""
    n = scene.model.n_joints
    done = solve_ivp(
        rates,
        (scene.times[0], scene.times[-1]),
        np.concatenate([scene.start, np.zeros(n)]),
        "BDF",
        scene.times,
        rtol=LIMITS.relative,
        atol=LIMITS.absolute,
        max_step=LIMITS.max_step,
    )
    return np.asarray(done.y[:n].T)


def casadi_cvodes(scene: Scene) -> Rival:
    """CVODES (Hindmarsh et al. 2005) through CasADi: explicit rates, exact Jacobian, forward sensitivities."""
    n, p = scene.model.n_joints, parameter_vector(scene.model)
    x, free = casadi.SX.sym("x", 2 * n), casadi.SX.sym("free", scene.directions.shape[1])
    packed = casadi.vertcat(x, casadi.SX.zeros(n + 2), p + casadi.DM(scene.directions) @ free, 0.0)
    answer = SymbolicBalance(scene.model).stage(packed)  # with h g = 0: r and dr/dv
    rates = casadi.vertcat(x[n:], -casadi.solve(casadi.reshape(answer[n:], n, n), answer[:n]))
    options = {"reltol": LIMITS.relative, "abstol": LIMITS.absolute, "max_step_size": LIMITS.max_step}
    options |= {"max_num_steps": 100_000}
    integrator = casadi.integrator(
        "release", "cvodes", {"x": x, "p": free, "ode": rates}, 0.0, list(scene.times[1:]), options
    )
    x0, none = np.concatenate([scene.start, np.zeros(n)]), np.zeros(free.numel())
    forward = integrator.forward(free.numel())
    seeds = casadi.DM.eye(free.numel())

    def run() -> Array:
        states = integrator(x0=x0, p=none)["xf"].full().T
        return np.concatenate([scene.start[None], states[:, :n]])

    def with_derivatives() -> Array:
        found = integrator(x0=x0, p=none)
        forward(x0=x0, p=none, out_xf=found["xf"], fwd_p=seeds)
        return np.concatenate([scene.start[None], found["xf"].full().T[:, :n]])

    return Rival("CVODES by CasADi", run, with_derivatives)


def sundae_cvode(scene: Scene, equations: CompiledEquations) -> Rival | None:
    """CVODE through scikit-sundae, with rates and exact Jacobian by numba; None if it is not installed."""
    try:
        from sksundae.cvode import CVODE
    except ImportError:
        return None
    from tools.benchmarks.dynamics.numba_rates import rates_and_jacobian

    n = scene.model.n_joints
    rates, jacobian = rates_and_jacobian(address_of(equations.newton), n, parameter_vector(scene.model))
    solver = CVODE(
        rates,
        rtol=LIMITS.relative,
        atol=LIMITS.absolute,
        max_step=LIMITS.max_step,
        max_num_steps=100_000,
        jacfn=jacobian,
    )
    x0 = np.concatenate([scene.start, np.zeros(n)])
    return Rival(SUNDAE, lambda: solver.solve(scene.times, x0).y[:, :n])
