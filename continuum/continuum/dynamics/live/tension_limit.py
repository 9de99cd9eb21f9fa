"""From tension commands to the tension that pulls: bounded, no faster than allowed, slack when commands stop coming."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.live.stepper import Interval


@dataclass(frozen=True)
class TensionLimits:
    """What commands may ask for, and what happens without them.

    Attributes:
        max_tension: of each cable [N].
        max_rate: of a commanded change [N/s].
        patience: time without a command after which the cables are let go [s].
        slack_time: time in which they are then slack [s]: each tension falls linearly; 0 for at once.
    """

    max_tension: float
    max_rate: float
    patience: float
    slack_time: float


class TensionLimiter:
    """The tensions of the cables over time. Times [s] are of any one clock that does not go back.

    Args:
        limits: of tension.
        n_cables: number of cables.

    Attributes:
        tension: of each cable now, (n_cables,) [N].
        abandoned: a tight cable was let go, as commands stopped coming; False again with the next one.
    """

    def __init__(self, limits: TensionLimits, n_cables: int) -> None:
        self._limits = limits
        self._slack = np.zeros(n_cables)
        self.release()

    def release(self) -> None:
        """Slack at once; what was commanded is forgotten."""
        self.tension = self._slack
        self._goal = self._slack
        self._rate = np.full_like(self._slack, self._limits.max_rate)  # of change [N/s]
        self._received = -np.inf
        self.abandoned = False

    def command(self, wanted: Array, now: float) -> None:
        """Go for tensions (n_cables,) [N], finite and none negative; those above the limit mean the limit."""
        self._goal = np.minimum(wanted, self._limits.max_tension)
        self._rate = np.full_like(self._slack, self._limits.max_rate)
        self._received = now
        self.abandoned = False

    def abandon(self) -> None:
        """Let go of the cables: slack within the slack time, unless a command comes."""
        if self.tight and not self.abandoned:
            self.abandoned = True
            self._goal = self._slack
            if self._limits.slack_time > 0:
                self._rate = self.tension / self._limits.slack_time
            else:
                self.tension = self._slack

    def forget_time(self) -> None:
        """The clock went back: who commanded has to do so again, or the cables are let go."""
        self._received = -np.inf

    def move_on(self, now: float, duration: float) -> Interval:
        """The tensions from ``now`` on for a ``duration`` [s], which then are those of the follower."""
        if now - self._received > self._limits.patience:
            self.abandon()
        before, most = self.tension, self._rate * duration
        self.tension = np.maximum(before + np.clip(self._goal - before, -most, most), 0.0)
        return Interval(duration, before, self.tension)

    @property
    def tight(self) -> bool:
        """Whether a cable pulls, or is to pull."""
        return bool(np.any(self.tension > 0) or np.any(self._goal > 0))
