"""Interface of the integrators that advance a simulated arm by one interval."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from continuum.arrays import Array
from continuum.dynamics.trajectory import SimulationStatus


@dataclass(frozen=True)
class Interval:
    """A short time interval in which the tensions change linearly.

    Attributes:
        duration: length of the interval [s], > 0.
        before, after: tension of each cable at the start and at the end of the interval, (n_cables,) [N].
    """

    duration: float
    before: Array
    after: Array


class Stepper(Protocol):
    """An integrator that is called for consecutive intervals."""

    def advance(self, x: Array, interval: Interval) -> tuple[SimulationStatus, Array]:
        """Return the status and the state (n_x,) [rad, rad/s, ...] at the end, valid if the status is COMPLETE."""
        ...
