"""What of the commanded tensions a node lets through to a bench, and when it lets nothing through."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.live.tension_limit import TensionLimiter, TensionLimits

LONGEST = 0.05
"""Time [s] for which tension changes in one go: after a stall it goes on from where it was, no faster than before."""


class CommandGate:
    """Shut at the start. Open, it lets commands through within limits; it shuts to zero at once.

    Zero at once is what the node asks for: how fast tension then falls is the bench controller's to keep.
    Times [s] are of any one clock that does not go back.

    Args:
        limits: of tension.
        n_cables: number of cables.

    Attributes:
        is_open: commands pass.
        stopped: latched; it does not open before :meth:`reset`.
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
        """Tension asked of each cable now, (n_cables,) [N]."""
        return self._limiter.tension

    @property
    def abandoned(self) -> bool:
        """Commands stopped coming while a cable was tight."""
        return self._limiter.abandoned

    @property
    def decided(self) -> float | None:
        """When what is asked for was decided; None for just now.

        Of tension that falls since commands stopped: when they did, so that the bench, too, ends it in its own time.
        """
        if self._commanded is None or not self.abandoned:
            return self._commanded
        return self._commanded + self._patience if self.is_tight else None

    @property
    def is_tight(self) -> bool:
        return bool(np.any(self.set_point > 0))

    def open(self) -> bool:
        """Let commands through from now on, from zero; False while a stop is latched."""
        if not self.stopped:
            self.let_go()
            self._last, self.is_open = None, True
        return self.is_open

    def shut(self) -> None:
        """Zero, and nothing through."""
        self.is_open = False
        self.let_go()

    def let_go(self) -> None:
        """Zero; later commands go through as before."""
        self._limiter.release()
        self._commanded = None

    def stop(self) -> None:
        """Shut and latch."""
        self.stopped = True
        self.shut()

    def reset(self) -> None:
        """Forget the stop; the gate stays shut."""
        self.stopped = False

    def command(self, wanted: Array, at: float) -> bool:
        """Go for tensions (n_cables,) [N], finite and none negative, said at ``at``; False where nothing passes."""
        if self.is_open:
            self._limiter.command(wanted, at)
            self._commanded = at
        return self.is_open

    def move_on(self, now: float) -> Array:
        """Follow the commands up to ``now``: the set point, (n_cables,) [N]."""
        passed = 0.0 if self._last is None else min(now - self._last, LONGEST)
        self._last = now
        if self.is_open:
            self._limiter.move_on(now, passed)
        return self.set_point
