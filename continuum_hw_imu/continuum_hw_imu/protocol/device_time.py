"""The device's clock of 32 bits [us], which begins anew every 71.6 minutes, as one that does not."""

from __future__ import annotations

from continuum_hw_imu.protocol.frame import WRAP_TIME

MICROSECONDS = 1e6
"""In a second."""


def signed_difference(later: int, earlier: int) -> int:
    """How much later [us] one reading of the clock is than another, of those within half a turn of 71.6 minutes."""
    return (later - earlier + WRAP_TIME // 2) % WRAP_TIME - WRAP_TIME // 2


class DeviceTime:
    """Follows one device's clock. A reading up to 35 minutes before the newest is taken as of before, not of a turn."""

    def __init__(self) -> None:
        self._newest: int | None = None

    def forget(self) -> None:
        """The device began anew."""
        self._newest = None

    def unwrapped(self, time: int) -> int:
        """The time [us] since the turn of the clock in which the first reading was."""
        if self._newest is None:
            self._newest = time
        whole = self._newest + signed_difference(time, self._newest % WRAP_TIME)
        self._newest = max(self._newest, whole)
        return whole
