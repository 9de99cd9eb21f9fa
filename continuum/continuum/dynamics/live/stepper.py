"""What moves a simulated arm on by one interval."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from continuum.arrays import Array
from continuum.dynamics.trajectory import SimulationStatus


@dataclass(frozen=True)
class Interval:
    """A short time in which the tensions change linearly.

    Attributes:
        duration: [s], > 0.
        before, after: tension of each cable at its start and at its end, (n_cables,) [N].
    """

    duration: float
    before: Array
    after: Array


class Stepper(Protocol):
    """An integrator, called for one interval after the other."""

    def advance(self, x: Array, interval: Interval) -> tuple[SimulationStatus, Array]:
        """State (n_x,) [rad, rad/s, ...] at the end of the interval; to be used where the status is COMPLETE."""
        ...
