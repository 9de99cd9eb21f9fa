"""The page of the numerics: which integrator and why, around figures that were measured just now."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from tools.bench_dynamics.growth import SECONDS, Size, exponent
from tools.bench_dynamics.orders import STEPS, Convergence
from tools.bench_dynamics.rivals import BASELINE


@dataclass(frozen=True)
class Score:
    """One way to integrate the release: processor time [s], largest error [deg], time with ten sensitivities [s]."""

    name: str
    seconds: float
    error: float
    with_slopes: float | None


@dataclass(frozen=True)
class Result:
    """All that was measured; the last score is that of the library's default."""

    scores: Sequence[Score]
    sizes: list[Size]
    convergence: Sequence[Convergence]
    slope_errors: Mapping[float, float]

    @property
    def best(self) -> Score:
        """The library's default."""
        return self.scores[-1]

    @property
    def baseline(self) -> Score:
        """SciPy's BDF as one would call it."""
        return next(score for score in self.scores if score.name == BASELINE)

    @property
    def speed_up(self) -> float:
        """How many times as fast as the baseline the library's default is."""
        return self.baseline.seconds / self.best.seconds

    @property
    def is_reached(self) -> bool:
        """Whether the goal of speed and nearness is."""
        return self.speed_up >= 50 and self.best.error <= 0.05

    @property
    def exponent(self) -> float:
        """Growth of time with the number of joints."""
        return exponent(self.sizes)


def page(result: Result) -> str:
    """The whole page."""
    best, largest, verdict = result.best, result.sizes[-1], "Reached" if result.is_reached else "Missed"
    return f"""# Numerics: how Eq. 12 is integrated

Made by `make bench-dynamics`, which writes every table here. Times are processor times on one core, the shortest of
several runs, of the integration alone with all code compiled and loaded: read them as ratios within the page. A
program waits longer: for the elapsed time on a machine with other work, and before its first run for loading
(`continuum simulate` tells the two apart).
{machine()}

## One release, every integrator

The prototype (Tables 1 and 3) from 15 degrees at every joint, 1.6 s, 193 outputs, at the thesis's tolerances: relative
1e-4, absolute 1e-5, steps up to 0.01 s. The error is the largest of any joint at any output, against a solution at
tolerances ten thousand times tighter. Sensitivities are those of all states to ten parameters.

| integrator | time [ms] | times as fast | error [deg] | with sensitivities [ms] |
|---|---|---|---|---|
{_rows(result)}

Goal: at least 50 times as fast as SciPy's BDF with NumPy, at no more than 0.05 degrees from a converged solution.
{verdict}: {result.speed_up:.0f} times, {best.error:.4f} degrees. The baseline's NumPy is written for this case alone
(slack cables, no effects, as few operations as possible); against the library's own terms in NumPy the ratio is
{result.scores[1].seconds / best.seconds:.0f}.

## Which, and why

The reference is SciPy's BDF, the nearest kin of the thesis's `ode15s`, with the exact Jacobian. It spends most of its
time in its own Python, so compiled equations alone help it little. CVODE and CVODES are rid of that, but are still
called through Python or CasADi's interpreter. The fast path is an ESDIRK method (Kennedy and Carpenter 2003: order 3
with 4 stages, order 4 with 6), loops and equations compiled, the loops once for all models:

- It solves the implicit equations r(x, v, u, p) = 0 as they stand: no mass matrix is inverted, and effects with states
  or with inertia of their own need nothing special.
- One step is self-contained. Dry friction makes joints stick and slip all the time; a multistep method loses its
  history at every such corner and starts again at low order, a one-step method just takes a short step.
- Sensitivities cost one linear solve a stage, with a matrix that is there already (below). CVODES integrates them as
  further states.
- Steps end on outputs and where tensions bend: nothing is interpolated, and no short pull is stepped over.
- The length of a step follows a proportional-integral control (Gustafsson 1991): half as many refused steps at the
  corners of friction as by the last error alone, and a smaller error for the same time. Newton's matrix is kept within
  a step as long as the iteration converges fast with it.

One definition of the physics serves all of them: the equations of `continuum.dynamics.planar` are traced once with
CasADi's symbols, from which come exact derivatives and C code. The thesis's tolerances are the default.

## Orders of convergence, measured

Errors of the joint angles after 0.4 s [deg], steps of one length, the prototype without dry friction and with heavier
discs, so that these steps see all that happens.

| method | {" | ".join(f"{steps} steps" for steps in STEPS)} | measured orders |
|---|{"---|" * len(STEPS)}---|
{chr(10).join(_order_row(method) for method in result.convergence)}

The conditions of order, L-stability and the error estimate are tested too, in `continuum/test/test_esdirk.py`.

## Sensitivities: how they are made, how they are checked

A stage solves r(x, v) = 0 with x = base + h g rates. Differentiating that very equation gives the slope of its rates by
one solve with J = dr/dv + h g dr/d(theta', z) + (h g)^2 dr/dtheta, the matrix of Newton's method, and exact dr/dx and
dr/dp. So the sensitivities are those of the computed trajectory with its steps held. Tests compare them with
differences of runs that take the same steps (agreement of 2e-6), for every parameter and the initial state, with and
without effects.

They are as good as the trajectory is. Against differences of runs at much tighter tolerances, the largest error over
1.6 s in units of each parameter's largest sensitivity:

| relative tolerance | {" | ".join(f"{relative:.0e}" for relative in result.slope_errors)} |
|---|{"---|" * len(result.slope_errors)}
| error | {" | ".join(f"{100 * error:.2g} %" for error in result.slope_errors.values())} |

The worst places are the corners where a joint sticks or slips: a sensitivity jumps there, a little early or late.

## Longer arms

Links like the prototype's, bent by 75 degrees in total and let go; the first {SECONDS:g} s, ESDIRK3.

| joints | compiling, once [s] | processor time of a simulated second [s] | steps a second |
|---|---|---|---|
{chr(10).join(_size_row(size) for size in result.sizes)}

Time grows with the number of joints to the power {result.exponent:.2f}, mostly by Newton's matrix, whose entries are as
many as the joints squared and whose factors take their cube; the number of steps grows at first only. Three things keep
{largest.n_joints} joints in reach. Torques are summed along the arm, in a number of operations that grows with n alone,
so that an iteration without a new matrix costs little. The matrix is one derivative, in one direction a joint, not
three Jacobians. And the C code of long arms is cut into short functions, as compilers take the square of a function's
length. Compiling (elapsed time, other work on the machine included) is what hurts; its result is kept, and values of
parameters are no part of it.
"""


def machine() -> str:
    """What the figures were measured on."""
    packages = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "numba", "casadi"))
    return f"Measured on {_processor()}, Python {platform.python_version()}, {packages}."


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return named[0] if named else platform.machine()


def _rows(result: Result) -> str:
    rows = []
    for score in result.scores:
        sensitivities = "" if score.with_slopes is None else f"{1e3 * score.with_slopes:.1f}"
        ratio = result.baseline.seconds / score.seconds
        rows.append(f"| {score.name} | {1e3 * score.seconds:.1f} | {ratio:.1f} | {score.error:.4f} | {sensitivities} |")
    if not any("sundae" in score.name for score in result.scores):
        rows.append("| CVODE by scikit-sundae | not installed | | | |")
    return "\n".join(rows)


def _order_row(method: Convergence) -> str:
    errors = " | ".join(f"{error:.1e}" for error in method.errors)
    return f"| {method.name} | {errors} | {', '.join(f'{order:.2f}' for order in method.orders)} |"


def _size_row(size: Size) -> str:
    return f"| {size.n_joints} | {size.compiling:.1f} | {size.per_second:.3g} | {size.steps:.0f} |"
