"""A random arm, one interval of its motion, and an arm whose motion is linear."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from estimation_arm import N, drawn_values, run_over, slipping, structure

from continuum.estimation.friction_modes import FrictionModes
from continuum.estimation.run import Run, Trajectory
from continuum.estimation.transition import Transition, transition

SMOOTH = {
    "coulomb_friction": 0.0, "capstan_friction": 0.0, "capstan.friction": 0.0, "load_friction.radius": 0.0,
    "sensor_cable.dry": 0.0,
}  # fmt: skip
"""An arm whose friction has no sign: it moves alike, whatever rate dry friction gets."""
SHORT = 1e-3  # s: one substep
LONG = 0.02  # s: several


@dataclass(frozen=True)
class Arm:
    """A random arm somewhere, and intervals that begin there.

    Attributes:
        values: parameters.
        x: angles and rates.
        u: tensions.
        d: missing torque.
    """

    values: np.ndarray
    x: np.ndarray
    u: np.ndarray
    d: np.ndarray

    @classmethod
    def drawn(cls, seed: int, with_effects: bool = True, **changed: float) -> Self:
        """Tensions and a missing torque too, rates not small."""
        random = np.random.default_rng(seed)
        values = drawn_values(random, with_effects, **changed)
        rate = random.choice([-1.0, 1.0], N) * random.uniform(0.5, 2, N)
        x = np.concatenate([random.uniform(-0.5, 0.5, N), rate])
        return cls(values, x, random.uniform(0.5, 6, 2), random.normal(0, 0.05, N))

    def interval(self, length: float) -> Run:
        """A run of this interval alone."""
        return run_over(np.array([0.0, length]), self.u)

    def substeps(self, length: float) -> int:
        """Their number."""
        return int(self.interval(length).first[-1])

    @property
    def slips(self) -> FrictionModes:
        """All joints as they move."""
        return slipping(np.sign(self.x[N:])[None])

    def over(
        self,
        length: float,
        modes: FrictionModes | None = None,
        x: np.ndarray | None = None,
        d: np.ndarray | None = None,
        held: np.ndarray | None = None,
        gained: np.ndarray | float = 0.0,
        reference: np.ndarray | None = None,
    ) -> Transition:
        """One interval from a state, its own without, along a trajectory whose rates gain so much."""
        x, d = self.x if x is None else x, self.d if d is None else d
        q, w = np.stack([x[:N], x[:N] + length * x[N:]]), np.stack([x[N:], x[N:] + gained])
        held = np.zeros((self.substeps(length), N)) if held is None else held
        values, way = self.values, Trajectory(q, w, np.zeros((2, N)), np.stack([d, d]))
        reference = values if reference is None else reference
        return transition(
            structure().equations, self.interval(length), way, modes or self.slips, values, reference, held
        )

    def gained(self, length: float) -> np.ndarray:
        """By how much the rates change over an interval, by the interval itself."""
        gained = np.zeros(N)
        for _ in range(4):
            gained = self.over(length, gained=gained).end[0, N:] - self.x[N:]
        return gained


def linear_arm(seed: int) -> Arm:
    """Links without weight: inertia that no posture changes; springs and viscous friction, some very stiff."""
    random = np.random.default_rng(seed)
    arm = Arm.drawn(seed, False, mass=1e-9, stribeck_gain=0.0, friction_slope=1e4)
    for name in ("stiffness", "viscous_friction"):
        arm.values[structure().slots[name]] *= 10 ** random.uniform(-1, 2, N)
    return replace(arm, u=np.zeros(2))


def relative(found: np.ndarray, expected: np.ndarray, scale: np.ndarray | None = None) -> float:
    """Largest error by the largest entry."""
    return float(np.max(np.abs(found - expected)) / np.max(np.abs(expected if scale is None else scale)))
