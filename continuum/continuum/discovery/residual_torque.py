"""What torque is missing at every joint, window by window: inverse dynamics without differentiating anything measured.

A constant torque at each joint during a window that would explain the window's errors, by least squares; a window's own
first state is free as ever. Accelerations are not needed, which at 120 Hz no sensor gives.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.discovery.question import Question
from continuum.discovery.trial import TOLERANCES
from continuum.discovery.turns import way_since_turn
from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.motion import Motion
from continuum.dynamics.simulator import Simulator
from continuum.effects.parts.joint_force import joint_force
from continuum.identification.arrow_least_squares import reduced
from continuum.identification.fit import fit
from continuum.identification.free import Free

_TYPICAL = 0.01  # N m
_TOLD = 0.02  # N m, largest standard deviation
_ITERATIONS = 1


class ExtraTorque(Effect):
    """A constant torque at each joint, [N m] on the right side of Eq. 12."""

    name = "residual_torque"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "torque": Parameter("tau", "N m", -1e3, 1e3, True, "what is missing", 0.0, _TYPICAL)
    }

    def torque(self, now: Instant, own: Own, state: Numbers) -> Numbers:  # noqa: ARG002
        """Minus the torque, as it stands on the left."""
        return -own["torque"]


@dataclass(frozen=True)
class ResidualTorque:
    """Missing torque of one run's windows, and what the arm did there.

    Attributes:
        run: name.
        times: middle of each window, (n_windows,) [s].
        torque, deviation: missing torque and its standard deviation by noise alone, (n_windows, n_joints) [N m].
        theta, theta_rate: joint angles and rates there, (n_windows, n_joints) [rad, rad/s].
        tension: of the cables, (n_windows, n_cables) [N].
        load: force that each joint passes on, (n_windows, n_joints) [N].
        way_since_turn: how far each joint has gone since it last turned back, (n_windows, n_joints) [rad].
    """

    run: str
    times: Array
    torque: Array
    deviation: Array
    theta: Array
    theta_rate: Array
    tension: Array
    load: Array
    way_since_turn: Array

    @property
    def is_told(self) -> NDArray[np.bool_]:
        """Where the data tell it, (n_windows, n_joints); a joint that sticks shows only that it is small."""
        return self.deviation < _TOLD


def residual_torques(question: Question, models: Sequence[Model]) -> list[ResidualTorque]:
    """Of every run that its model can be simulated in.

    Args:
        question: data.
        models: fitted; one for each recording, as what a recording has for itself differs.
    """
    found = []
    for recording, model in zip(question.recordings, models, strict=True):
        n = model.n_joints
        extra = ActiveEffect(ExtraTorque(), {"torque": np.zeros(n)})
        simulator = Simulator(replace(model, effects=(*model.effects, extra)), TOLERANCES)
        free = [Free("residual_torque.torque", joint) for joint in range(n)]
        fitted = fit(simulator, [recording], question.noise, free, iterations=_ITERATIONS)
        if not fitted.parts:
            continue
        torque, deviation, middle = [], [], []
        for rows, part, spread in zip(fitted.runs[0].rows, fitted.parts, fitted.unknowns.own_spread, strict=True):
            slopes = reduced(part, spread)
            covariance = np.linalg.inv(slopes.T @ slopes + 1e-6 * np.eye(n))
            at = fitted.coordinates - covariance @ slopes.T @ part.errors
            torque.append(_TYPICAL * at)
            deviation.append(_TYPICAL * np.sqrt(np.diag(covariance)))
            middle.append((rows.start + rows.stop) // 2)
        times = recording.times[middle]
        rate = np.gradient(recording.theta, recording.times, axis=0)
        rate = rate if recording.theta_rate is None else recording.theta_rate
        theta, tension = recording.theta[middle], recording.pull.over(times)
        found.append(
            ResidualTorque(
                recording.name,
                times,
                np.array(torque),
                np.array(deviation),
                theta,
                rate[middle],
                tension,
                np.array([_load(model, *at) for at in zip(theta, rate[middle], tension, strict=True)]),
                way_since_turn(recording.theta)[middle],
            )
        )
    return found


def _load(model: Model, theta: Array, theta_rate: Array, u: Array) -> Array:
    """Size of the force that each joint passes on, (n,) [N], the plate at rest."""
    motion = Motion(theta, theta_rate, np.zeros(theta.size), *np.zeros((3, 1)))
    return np.linalg.norm(joint_force(Instant(motion, u, model.changed_parameters)), axis=1)
