"""Unwrap the device's 32-bit clock [us], which wraps around every 71.6 minutes."""

from __future__ import annotations

from continuum_hw_imu.protocol.frame import WRAP_TIME

MICROSECONDS = 1e6
"""Microseconds in a second."""


def signed_difference(later: int, earlier: int) -> int:
    """Return the difference [us] of two readings that are less than half a period of 71.6 minutes apart."""
    return (later - earlier + WRAP_TIME // 2) % WRAP_TIME - WRAP_TIME // 2


class DeviceTime:
    """Unwrapped clock of one device. A reading up to 35 minutes before the newest counts as earlier, not as a wrap."""

    def __init__(self) -> None:
        self._newest: int | None = None

    def forget(self) -> None:
        """Start over after a restart of the device."""
        self._newest = None

    def unwrapped(self, time: int) -> int:
        """Return the time [us] since the last wrap of the clock before the first reading."""
        if self._newest is None:
            self._newest = time
        whole = self._newest + signed_difference(time, self._newest % WRAP_TIME)
        self._newest = max(self._newest, whole)
        return whole
