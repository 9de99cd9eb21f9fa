"""Motions over time: the result of a simulation, or the reason of its failure, and the sensor readings."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from continuum.arrays import Array


class SimulationStatus(Enum):
    """How a simulation ended."""

    COMPLETE = "complete"
    STEP_TOO_SMALL = "no step was small enough for the tolerance, or too many were needed"
    NOT_FINITE = "the equations have no finite solution"
    NO_MODES = "no combination of sticking and slipping joints satisfies the laws of friction"


@dataclass(frozen=True)
class Trajectory:
    """States of the arm over time; NaN from where a simulation failed.

    Attributes:
        status: outcome of the simulation; the states are valid only if it is COMPLETE.
        times: (n_times,) [s].
        states: joint angles, joint rates, states of effects, (n_times, n_x) [rad, rad/s, ...].
        n_joints: number of joints.
        steps, refused: number of accepted steps and of repeated steps (SciPy's BDF does not report the latter: 0).
        sensitivities: those of the states to the free quantities, (n_times, n_x, n_free); n_free may be 0.
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
    """Sensor readings of a motion: joint angles and rates at the sampled times.

    Attributes:
        times: (n_times,) [s].
        theta: joint angles, (n_times, n_joints) [rad].
        theta_rate: joint rates, (n_times, n_joints) [rad/s].
        begun: start time [s] of the recording that these readings are part of.
    """

    times: Array
    theta: Array
    theta_rate: Array
    begun: float
