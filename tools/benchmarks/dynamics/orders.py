"""Orders of convergence measured with fixed steps, and sensitivities against differences of runs."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.integration.esdirk_tableau import Tableau, fourth_order, third_order
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import parameter_vector
from tools.benchmarks.dynamics.scene import Scene, prototype_release

STEPS = (40, 80, 160)  # in 0.4 s
_SMOOTH = {"coulomb_friction": 0.0, "inertia": 5e-3}  # the larger inertia lets these steps resolve the motion
_DIFFERENCE = 1e-4  # of a parameter


@dataclass(frozen=True)
class Convergence:
    """Errors of one method, and the orders between them.

    Attributes:
        name: of the method.
        errors: largest error of a joint angle after 0.4 s with each number of steps [deg].
    """

    name: str
    errors: Array

    @property
    def orders(self) -> Array:
        """Orders between each number of steps and the next, which is twice as large."""
        return np.asarray(-np.diff(np.log2(self.errors)))


def convergence() -> list[Convergence]:
    """Measure the prototype's release without dry friction and with heavier discs, in fixed steps."""
    model = prototype_release().model.with_values(_SMOOTH)

    def end(tableau: Tableau, steps: int) -> Array:
        blind = replace(tableau, error=np.zeros_like(tableau.error))  # so that no estimate changes a step
        times = np.linspace(0.0, 0.4, steps + 1)
        run = Simulator(model, Tolerances(1e-12, 1e-12, 1.0), blind).run(np.full(model.n_joints, 0.2), times)
        return np.degrees(run.theta[-1])

    exact = end(fourth_order(), 4 * STEPS[-1])
    methods = {"ESDIRK3": third_order(), "ESDIRK4": fourth_order()}
    return [
        Convergence(name, np.array([np.abs(end(tableau, steps) - exact).max() for steps in STEPS]))
        for name, tableau in methods.items()
    ]


def slope_error(scene: Scene, limits: Tolerances) -> float:
    """Return the largest error of the sensitivities at these tolerances, relative to each parameter's largest one.

    The reference is central differences of runs at a relative tolerance of 1e-9.
    """
    found = Simulator(scene.model, limits).run(scene.start, scene.times, free=scene.directions).sensitivities
    tight = Simulator(scene.model, Tolerances(1e-9, 1e-10, 0.01), fourth_order())
    values, worst = parameter_vector(scene.model), 0.0
    for k, direction in enumerate(scene.directions.T):
        step = _DIFFERENCE * float(np.abs(values[direction != 0]).max())
        sides = [
            tight.run(scene.start, scene.times, values=values + side * step * direction).states for side in (1, -1)
        ]
        expected = (sides[0] - sides[1]) / (2 * step)
        n = scene.model.n_joints
        error = np.abs(found[:, :n, k] - expected[:, :n]).max()
        worst = max(worst, float(error / np.abs(expected[:, :n]).max()))
    return worst
