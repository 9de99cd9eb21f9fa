"""Applied tension from tension commands: limited in size and rate, and slack when commands stop."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.live.stepper import Interval


@dataclass(frozen=True)
class TensionLimits:
    """Limits of the commands, and the reaction to missing commands.

    Attributes:
        max_tension: largest tension of each cable [N].
        max_rate: largest rate of a commanded change [N/s].
        patience: time without a command after which the cables are released [s].
        slack_time: duration of the release [s]: each tension falls linearly to zero; 0 releases at once.
    """

    max_tension: float
    max_rate: float
    patience: float
    slack_time: float


class TensionLimiter:
    """The tensions of the cables over time. Times [s] are those of one monotonic clock.

    Args:
        limits: limits of the tensions.
        n_cables: number of cables.

    Attributes:
        tension: current tension of each cable, (n_cables,) [N].
        abandoned: whether a tight cable was released because commands stopped; the next command resets it.
    """

    def __init__(self, limits: TensionLimits, n_cables: int) -> None:
        self._limits = limits
        self._slack = np.zeros(n_cables)
        self.release()

    def release(self) -> None:
        """Make the cables slack at once and discard the last command."""
        self.tension = self._slack
        self._goal = self._slack
        self._rate = np.full_like(self._slack, self._limits.max_rate)  # of change [N/s]
        self._received = -np.inf
        self.abandoned = False

    def command(self, wanted: Array, now: float) -> None:
        """Set the goal tensions (n_cables,) [N], finite and not negative; they are clipped to the limit."""
        self._goal = np.minimum(wanted, self._limits.max_tension)
        self._rate = np.full_like(self._slack, self._limits.max_rate)
        self._received = now
        self.abandoned = False

    def abandon(self) -> None:
        """Release the cables within the slack time, unless a new command arrives."""
        if self.tight and not self.abandoned:
            self.abandoned = True
            self._goal = self._slack
            if self._limits.slack_time > 0:
                self._rate = self.tension / self._limits.slack_time
            else:
                self.tension = self._slack

    def forget_time(self) -> None:
        """Discard the time of the last command after the clock went back: without a new one the cables are released."""
        self._received = -np.inf

    def move_on(self, now: float, duration: float) -> Interval:
        """Advance the tensions by ``duration`` [s] from the time ``now`` [s] and return their interval."""
        if now - self._received > self._limits.patience:
            self.abandon()
        before, most = self.tension, self._rate * duration
        self.tension = np.maximum(before + np.clip(self._goal - before, -most, most), 0.0)
        return Interval(duration, before, self.tension)

    @property
    def tight(self) -> bool:
        """Whether a cable is under tension or commanded to be."""
        return bool(np.any(self.tension > 0) or np.any(self._goal > 0))
