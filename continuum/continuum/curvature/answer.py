"""All holds of some recordings compared with constant curvature and a dynamic model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.curvature.comparison import Comparison, Overall, compare, overall
from continuum.curvature.holds import Hold, find_holds
from continuum.curvature.median_error import median_errors
from continuum.dynamics.model import Model
from continuum.dynamics.statics.resting_arm import RestingArm
from continuum.dynamics.trajectory import Reading
from continuum.errors import InvalidValueError
from continuum.inertial.stillness import SHORTEST_REST
from continuum.recordings.recording import Recording

_CORRECTIONS = 30
"""Corrections of sensor readings: at a gain of 1.5, the largest, each leaves half of the error."""


@dataclass(frozen=True)
class Answer:
    """What the recordings show.

    Attributes:
        holds: holds in the order of the recordings and of time.
        each: comparison of each hold.
        overall: comparison of all together.
    """

    holds: tuple[Hold, ...]
    each: tuple[Comparison, ...]
    overall: Overall

    @property
    def most_bent(self) -> int:
        """The hold with the largest total bend, from 0."""
        return int(np.argmax([abs(one.theta.sum()) for one in self.each]))


def answer(model: Model, holds: Sequence[Hold], slow: float | None = None) -> Answer:
    """Compare each hold, and all together.

    Args:
        model: model of the arm.
        holds: one or more holds, of one recording or several.
        slow: standard deviation of the angles' error that is not white [rad]; None: see `median_errors`.

    Raises:
        InvalidValueError: joint torques drive the model, it has only one joint or another number than was recorded, or
            it cannot hold one of the bends.
    """
    arm, errors = RestingArm(model), median_errors(holds, slow)
    for hold in holds:
        hold.recording.inputs_for(model)
    each = [
        compare(arm, true_angles(model, hold), errors.covariance(k), hold.tension, hold.approach)
        for k, hold in enumerate(holds)
    ]
    return Answer(tuple(holds), tuple(each), overall(each, errors))


def holds_of(model: Model, recordings: Sequence[Recording]) -> list[Hold]:
    """Return the holds of recordings of the model's arm; some recordings may have none.

    Raises:
        InvalidValueError: a recording has another number of joints or other inputs than the model, or none has a hold.
    """
    for recording in recordings:
        recording.inputs_for(model)
    found = [hold for recording in recordings for hold in find_holds(recording)]
    if not found:
        allowed = f"1 or more; a hold is {SHORTEST_REST:g} s without a motion, or rows of one tension before a release"
        raise InvalidValueError("number of holds", 0, allowed)
    return found


def true_angles(model: Model, hold: Hold) -> Array:
    """Return the joint angles of a hold without the errors of the model's sensors, (n,) [rad]."""
    begun = float(hold.recording.times[0])
    times, theta = np.array([begun + hold.since_begin]), hold.theta
    for _ in range(_CORRECTIONS):
        seen = Reading(times, theta[None], np.zeros_like(theta)[None], begun)
        for active in model.effects:
            seen = active.effect.measure(seen, active.values)
        theta = theta + hold.theta - seen.theta[0]
    return theta
