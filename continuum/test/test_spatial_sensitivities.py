"""Sensitivities of a simulation in space by every kind of value, against differences of the simulation itself."""

from functools import partial

import numpy as np
import pytest
from spatial_arms import equal_sections, rotation
from test_spatial_stepping import run

from continuum.dynamics.spatial import sensitivities as by
from continuum.dynamics.spatial.terms import cable_terms

OF_JOINT = {by.STIFFNESS: "stiffness", by.REST: "rest", by.VISCOUS: "viscous", by.COULOMB: "coulomb"}
OF_JOINT |= {by.STRIBECK_GAIN: "stribeck_gain", by.STRIBECK_SPEED: "stribeck_speed"}
OF_CHAIN = {by.ROTOR: "rotor", by.MASS: "mass", by.CENTER: "center", by.INERTIA: "inertia", by.OFFSET: "offset"}
OF_CABLE = {by.HOLE: "hole", by.CABLE_FRICTION: "friction", by.CABLE_SLOPE: "slope"}
OF_CABLE |= {by.CABLE_STIFFNESS: "stiffness", by.CABLE_DAMPING: "damping"}
STEP = {
    by.STIFFNESS: 1e-4, by.REST: 1e-5, by.VISCOUS: 1e-6, by.COULOMB: 1e-6, by.STRIBECK_GAIN: 1e-5,
    by.STRIBECK_SPEED: 1e-5, by.ROTOR: 1e-8, by.DRIVE: 1e-5, by.MASS: 1e-5, by.CENTER: 1e-6, by.INERTIA: 1e-8,
    by.OFFSET: 1e-6, by.GRAVITY: 1e-4, by.BASE: 1e-5, by.HOLE: 1e-6, by.CABLE_FRICTION: 1e-5, by.CABLE_SLOPE: 1e-1,
    by.CABLE_STIFFNESS: 1e-1, by.CABLE_DAMPING: 1e-3,
}  # fmt: skip
"""Step of each difference, in the unit of its value."""


class Case:
    """An arm with every law in it, in motion.

    Attributes:
        arm: chain, joints, cables.
        entries: kind, index and part of the values to differentiate by, (n_values, 3).
    """

    def __init__(self, holds: bool, steepness: float) -> None:
        rng = np.random.default_rng(7)
        chain, joints, cables = equal_sections(2, 2, friction=0.2)
        self.n, n_cables = chain.mass.size, cables.first.size - 1
        bodies = np.nonzero(chain.mass)[0]
        inertia, center = chain.inertia.copy(), chain.center.copy()
        inertia[bodies] += rng.normal(0.0, 5e-6, (bodies.size, 6))
        center[bodies] += rng.normal(0.0, 2e-3, (bodies.size, 3))
        base = rotation(np.array([0.3, -0.1, 0.2]))
        every = np.ones(self.n)
        self.arm = (
            chain._replace(inertia=inertia, center=center, base=base, rotor=1e-5 * every),
            joints._replace(rest=rng.normal(0.0, 0.1, self.n), stribeck_gain=0.75 * every, coulomb=0.02 * every),
            cables._replace(slope=steepness + 0.0 * cables.slope, stiffness=2e3 + 0.0 * cables.stiffness),
        )
        self.holds = np.arange(n_cables) % 2 == 0 if holds else np.zeros(n_cables, bool)
        straight = cable_terms(self.arm[0], self.arm[2], np.zeros(self.n))[0]
        self.command = np.where(self.holds, straight - 4e-3, rng.uniform(3.0, 9.0, n_cables))
        self.drive = rng.normal(0.0, 0.05, self.n)
        self.q, self.v = rng.normal(0.0, 0.3, self.n), rng.normal(0.0, 2.0, self.n)
        last, n_holes = self.n - 1, cables.body.size
        entries = [(kind, i, 0) for kind in (*OF_JOINT, by.ROTOR, by.DRIVE) for i in (0, last)]
        entries += [(by.MASS, i, 0) for i in bodies]
        entries += [(by.CENTER, bodies[1], part) for part in range(3)]
        entries += [(by.INERTIA, bodies[-1], part) for part in range(6)]
        entries += [(by.OFFSET, i, part) for i in (0, 2, 4) for part in range(3)]
        entries += [(kind, 0, part) for kind in (by.GRAVITY, by.BASE) for part in range(3)]
        entries += [(by.HOLE, k, part) for k in (0, 1, 2, n_holes - 1) for part in range(3)]
        of_cables = (by.CABLE_FRICTION, by.CABLE_SLOPE, by.CABLE_STIFFNESS, by.CABLE_DAMPING, by.COMMAND)
        entries += [(kind, c, 0) for kind in of_cables for c in (0, n_cables - 1)]
        self.entries = np.array(entries)

    def free(self) -> by.Free:
        kind, index, part = self.entries.T.copy()
        return by.Free(kind, index, part, np.arange(kind.size), np.ones(kind.size))

    def moved(self, entry: np.ndarray, step: float):
        """Run with one value changed by a step."""
        kind, index, part = (int(x) for x in entry)
        chain, joints, cables = self.arm
        command, drive = self.command.copy(), self.drive.copy()
        if kind in OF_JOINT:
            joints = self.stepped(joints, OF_JOINT[kind], (index,), step)
        elif kind in OF_CHAIN:
            at = (index,) if kind in (by.ROTOR, by.MASS) else (index, part)
            chain = self.stepped(chain, OF_CHAIN[kind], at, step)
        elif kind in OF_CABLE:
            cables = self.stepped(cables, OF_CABLE[kind], (index, part) if kind == by.HOLE else (index,), step)
        elif kind == by.GRAVITY:
            chain = self.stepped(chain, "gravity", (part,), step)
        elif kind == by.BASE:
            chain = chain._replace(base=rotation(step * np.eye(3)[part]) @ chain.base)
        elif kind == by.DRIVE:
            drive[index] += step
        else:
            command[index] += step
        return self.run((chain, joints, cables), self.q, self.v, command, drive)

    def started(self, k: int, step: float):
        """Run with one angle or rate of the start changed by a step."""
        start = step * np.eye(2 * self.n)[k]
        return self.run(self.arm, self.q + start[: self.n], self.v + start[self.n :], self.command, self.drive)

    @staticmethod
    def stepped(part, name: str, at: tuple[int, ...], step: float):
        array = getattr(part, name).copy()
        array[at] += step
        return part._replace(**{name: array})

    def run(self, arm, q, v, command, drive, free=None):
        return run(arm, q, v, 5e-4, 20, command, holds=self.holds, drive=drive, free=free)


@pytest.mark.parametrize("holds", [False, True], ids=["tensions", "lengths"])
@pytest.mark.parametrize("steepness", [2e2, 2e3])
def test_equal_differences(holds, steepness):
    """Central differences of fourth order, so that the curvature of the steep friction does not count."""
    case = Case(holds, steepness)
    found = case.run(case.arm, case.q, case.v, case.command, case.drive, case.free())
    n_values = len(case.entries)
    for column in range(n_values + 2 * case.n):
        if column < n_values:
            entry = case.entries[column]
            step, what = STEP.get(entry[0], 1e-06 if holds else 0.0001), f"{entry}"
            moved = partial(case.moved, entry)
        else:
            step, what = 1e-6, f"start {column - n_values}"
            moved = partial(case.started, column - n_values)
        runs = {k: moved(k * step) for k in (-2, -1, 1, 2)}
        assert all((one.mode == found.mode).all() for one in runs.values()), what
        for name, by_column in (("q", found.q_by[:, column]), ("v", found.v_by[:, column])):
            at = {k: getattr(one, name) for k, one in runs.items()}
            expected = (8.0 * (at[1] - at[-1]) - (at[2] - at[-2])) / (12.0 * step)
            tolerance = 1e-6 * abs(expected).max() + 1e-9
            np.testing.assert_allclose(by_column, expected, rtol=0.0, atol=tolerance, err_msg=f"{name} by {what}")
