"""Gate between tension commands and a bench: limits the commands, or blocks them."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.live.tension_limit import TensionLimiter, TensionLimits

LONGEST = 0.05
"""Longest time step of a tension change [s]: after a stall, tension continues at its normal rate."""


class CommandGate:
    """Passes commands within limits while open; initially shut. Shutting sets the tension to zero at once.

    This is the set point of the node; the bench controller limits the rate at which the tension then falls.
    Times [s] are those of one monotonic clock.

    Args:
        limits: limits of tension.
        n_cables: number of cables.

    Attributes:
        is_open: whether commands pass.
        stopped: whether a stop is latched, which blocks :meth:`open` until :meth:`reset`.
    """

    def __init__(self, limits: TensionLimits, n_cables: int) -> None:
        self._limiter = TensionLimiter(limits, n_cables)
        self._patience = limits.patience
        self._last: float | None = None
        self._commanded: float | None = None
        self.is_open = False
        self.stopped = False

    @property
    def set_point(self) -> Array:
        """Current set point of each cable, (n_cables,) [N]."""
        return self._limiter.tension

    @property
    def abandoned(self) -> bool:
        """Whether commands stopped while a cable was tight."""
        return self._limiter.abandoned

    @property
    def decided(self) -> float | None:
        """Time at which the set point was decided [s]; None for the present.

        For tension that falls after commands stopped, the time at which they stopped, so that the time-out of the bench
        applies too.
        """
        if self._commanded is None or not self.abandoned:
            return self._commanded
        return self._commanded + self._patience if self.is_tight else None

    @property
    def is_tight(self) -> bool:
        return bool(np.any(self.set_point > 0))

    def open(self) -> bool:
        """Open the gate, starting from zero tension; return False while a stop is latched."""
        if not self.stopped:
            self.let_go()
            self._last, self.is_open = None, True
        return self.is_open

    def shut(self) -> None:
        """Set the tension to zero and block commands."""
        self.is_open = False
        self.let_go()

    def let_go(self) -> None:
        """Set the tension to zero; later commands pass as before."""
        self._limiter.release()
        self._commanded = None

    def stop(self) -> None:
        """Shut the gate and latch the stop."""
        self.stopped = True
        self.shut()

    def reset(self) -> None:
        """Clear the stop; the gate stays shut."""
        self.stopped = False

    def command(self, wanted: Array, at: float) -> bool:
        """Set goal tensions (n_cables,) [N], finite and >= 0, decided at ``at`` [s]; False if the gate is shut."""
        if self.is_open:
            self._limiter.command(wanted, at)
            self._commanded = at
        return self.is_open

    def move_on(self, now: float) -> Array:
        """Advance to ``now`` [s] and return the set point, (n_cables,) [N]."""
        passed = 0.0 if self._last is None else min(now - self._last, LONGEST)
        self._last = now
        if self.is_open:
            self._limiter.move_on(now, passed)
        return self.set_point
