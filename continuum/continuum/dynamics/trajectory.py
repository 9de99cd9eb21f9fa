"""Motions over time: what a simulation gives, or the reason why it gives none, and what sensors read of it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from continuum.arrays import Array


class SimulationStatus(Enum):
    """How a simulation ended."""

    COMPLETE = "complete"
    STEP_TOO_SMALL = "no step was small enough for the tolerance, or too many were needed"
    NOT_FINITE = "the equations have no finite solution"


@dataclass(frozen=True)
class Trajectory:
    """States of the arm over time; NaN from where a simulation failed.

    Attributes:
        status: how the simulation ended; unless COMPLETE the states are not to be used.
        times: (n_times,) [s].
        states: joint angles, joint rates, states of effects, (n_times, n_x) [rad, rad/s, ...].
        n_joints: number of joints.
        steps, refused: steps that the integrator took, and that it had to repeat (SciPy's BDF: not told, 0).
        sensitivities: derivative of the states by the free quantities, (n_times, n_x, n_free); n_free may be 0.
    """

    status: SimulationStatus
    times: Array
    states: Array
    n_joints: int
    steps: int
    refused: int
    sensitivities: Array

    @property
    def theta(self) -> Array:
        """Joint angles, (n_times, n_joints) [rad]."""
        return self.states[:, : self.n_joints]

    @property
    def theta_rate(self) -> Array:
        """Joint rates, (n_times, n_joints) [rad/s]."""
        return self.states[:, self.n_joints : 2 * self.n_joints]


@dataclass(frozen=True)
class Reading:
    """What sensors read of a motion: joint angles and rates at the sampled times.

    Attributes:
        times: (n_times,) [s].
        theta: joint angles, (n_times, n_joints) [rad].
        theta_rate: joint rates, (n_times, n_joints) [rad/s].
        begun: when the recording began of which this may be a part [s].
    """

    times: Array
    theta: Array
    theta_rate: Array
    begun: float
