"""What was measured in one run of the arm."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.joint_torques import JointTorques, no_torques
from continuum.dynamics.model import InputKind, Model
from continuum.dynamics.tensions import LET_GO, Tensions, slack
from continuum.errors import InvalidValueError


@dataclass(frozen=True)
class Recording:
    """One run.

    Attributes:
        name: name of the run, for reports.
        times: rising times of the samples, (n_times,) [s].
        theta: joint angles, (n_times, n_joints) [rad].
        theta_rate: joint rates, (n_times, n_joints) [rad/s]; None if they were not measured.
        tensions: tensions of the cables, commanded or measured at the base; slack if None.
        notes: repairs made while reading, one sentence each.
        torques: torques of the joints' drives, commanded or measured; None if cables or nothing drives the arm.

    Raises:
        InvalidValueError: arrays that do not match or are not finite, times that do not rise, or both tensions and
            torques.
    """

    name: str
    times: Array
    theta: Array
    theta_rate: Array | None = None
    tensions: Tensions | None = None
    notes: tuple[str, ...] = ()
    torques: JointTorques | None = None

    def __post_init__(self) -> None:
        shape = (self.times.size, self.theta.shape[-1])
        for what, array, wanted in (
            ("times", self.times, shape[:1]),
            ("theta", self.theta, shape),
            ("theta_rate", self.theta_rate, shape),
        ):
            if array is not None and (array.shape != wanted or not np.all(np.isfinite(array))):
                raise InvalidValueError(f"{self.name}: {what}", array, f"finite numbers, {wanted}")
        if np.any(np.diff(self.times) <= 0):
            raise InvalidValueError(f"{self.name}: times", self.times, "rising")
        if self.torques is None:
            return
        if self.tensions is not None:
            raise InvalidValueError(f"{self.name}: inputs", "tensions and torques", "one or the other")
        if self.torques.n_inputs != self.n_joints:
            allowed = f"{self.n_joints}, one for each joint"
            raise InvalidValueError(f"{self.name}: number of torques", self.torques.n_inputs, allowed)

    @property
    def n_joints(self) -> int:
        """Number of joints."""
        return int(self.theta.shape[1])

    @cached_property
    def pull(self) -> Tensions:
        """Tensions of the cables over time.

        If there are none, no motor holds a cable. If constant tensions drop to zero from one row to the next and stay
        there to the end, the cables were let go.
        """
        if self.tensions is None or not np.any(self.tensions.values > 0):
            return slack()
        values, pulled = self.tensions.values, np.flatnonzero(np.any(self.tensions.values > 0, axis=1))
        if pulled[-1] + 1 >= len(values) or len(np.unique(values[: pulled[-1] + 1], axis=0)) > 1:
            return self.tensions
        released = values.copy()
        released[pulled[-1] + 1 :] = LET_GO
        return replace(self.tensions, values=released)

    @property
    def is_driven(self) -> bool:
        """Whether a cable ever pulls, or a drive ever turns its joint."""
        pulled = self.tensions is not None and np.any(self.tensions.values > 0)
        return bool(pulled or (self.torques is not None and np.any(self.torques.values)))

    def inputs_for(self, model: Model) -> InputSignal:
        """Return what drove the arm, as the model takes it; slack cables or zero torques if nothing did.

        Raises:
            InvalidValueError: the model takes other inputs than were recorded, or has another number of joints.
        """
        if model.n_joints != self.n_joints:
            raise InvalidValueError(f"{self.name}: number of joints", self.n_joints, f"{model.n_joints}, as the model")
        recorded = self.tensions if self.torques is None else self.torques
        if recorded is not None and recorded.kind is not model.inputs:
            allowed = f"{model.inputs.in_words}, which the model takes (inputs: {model.inputs.value})"
            raise InvalidValueError(f"{self.name}: kind of inputs", recorded.kind.in_words, allowed)
        if model.inputs is InputKind.CABLES:
            return self.pull
        return no_torques(self.n_joints) if self.torques is None else self.torques

    def rows(self, chosen: slice) -> Recording:
        """Return a part of the run with all of its inputs."""
        rate = None if self.theta_rate is None else self.theta_rate[chosen]
        return replace(self, times=self.times[chosen], theta=self.theta[chosen], theta_rate=rate)
