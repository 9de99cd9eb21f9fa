"""All holds of some recordings beside constant curvature and a dynamic model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.curvature.comparison import Comparison, Overall, compare, overall
from continuum.curvature.holds import Hold, find_holds
from continuum.curvature.median_error import median_errors
from continuum.dynamics.model import Model
from continuum.dynamics.reading import Reading
from continuum.dynamics.statics.resting_arm import RestingArm
from continuum.errors import InvalidValueError
from continuum.inertial.stillness import SHORTEST_REST
from continuum.recordings.recording import Recording

_CORRECTIONS = 30
"""Of what sensors read: a gain of 1.5, the largest, leaves half of the error each time."""


@dataclass(frozen=True)
class Answer:
    """What the recordings show.

    Attributes:
        holds: in the order of the recordings and of time.
        each: the comparison of each hold.
        overall: of all together.
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
        model: of the arm.
        holds: one or more, of one recording or several.
        slow: standard deviation of the angles' error that is not white [rad]; None: see `median_errors`.

    Raises:
        InvalidValueError: joint torques drive the model, it has one joint or another number than was recorded, or it
            cannot hold one of the bends.
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
    """Holds of recordings, each of which has one or more, of the model's arm.

    Raises:
        InvalidValueError: a recording has another number of joints or other inputs than the model, or no hold.
    """
    found: list[Hold] = []
    for recording in recordings:
        recording.inputs_for(model)
        here = find_holds(recording)
        if not here:
            allowed = (
                f"1 or more; a hold is {SHORTEST_REST:g} s without a motion, or rows of one tension before a release"
            )
            raise InvalidValueError(f"{recording.name}: number of holds", 0, allowed)
        found += here
    return found


def true_angles(model: Model, hold: Hold) -> Array:
    """Joint angles of a hold without what the model's sensors add to them, (n,) [rad]."""
    begun = float(hold.recording.times[0])
    times, theta = np.array([begun + hold.since_begin]), hold.theta
    for _ in range(_CORRECTIONS):
        seen = Reading(times, theta[None], np.zeros_like(theta)[None], begun)
        for active in model.effects:
            seen = active.effect.measure(seen, active.values)
        theta = theta + hold.theta - seen.theta[0]
    return theta
