"""A hand that moves the arm to a posture, holds it there and releases it: the thesis's release test."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array


@dataclass(frozen=True)
class Hand:
    """One movement of the hand.

    Attributes:
        begin: start time of the movement [s].
        start, goal: joint angles at its start and end, (n,) [rad].
        over: duration of the movement [s].
        hold: time for which the arm is then held still [s].
    """

    begin: float
    start: Array
    goal: Array
    over: float
    hold: float

    @property
    def end(self) -> float:
        """Time of the release [s]."""
        return self.begin + self.over + self.hold

    def motion(self, now: float) -> tuple[Array, Array]:
        """Return joint angles [rad] and rates [rad/s], (n,) each: smooth, without acceleration at its ends."""
        if now >= self.begin + self.over:
            return self.goal, np.zeros_like(self.goal)
        x = max(now - self.begin, 0.0) / self.over
        way = x**3 * (10.0 - 15.0 * x + 6.0 * x**2)
        speed = 30.0 * x**2 * (1.0 - x) ** 2 / self.over
        return self.start + way * (self.goal - self.start), speed * (self.goal - self.start)
