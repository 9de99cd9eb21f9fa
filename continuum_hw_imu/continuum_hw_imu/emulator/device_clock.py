"""The clock of the emulated controller: beside the machine's own, with a drift that may change."""

from __future__ import annotations

from continuum_hw_imu.protocol.device_time import MICROSECONDS


class DeviceClock:
    """Device times [us] unwrapped, real times [s] of a clock that is never set.

    Args:
        real: the present.
        shows: what the clock shows then [us].
        drift: how much faster than real time it runs, in parts of a million; also an attribute.
    """

    def __init__(self, real: float, shows: int = 0, drift: float = 0.0) -> None:
        self._real, self._shows = real, float(shows)
        self.drift = drift

    def at(self, real: float) -> int:
        """What it shows at a real time."""
        return round(self._shows + (real - self._real) * self._rate)

    def real(self, shows: float) -> float:
        """When it shows this."""
        return self._real + (shows - self._shows) / self._rate

    def drift_from(self, real: float, drift: float) -> None:
        """Run otherwise from a real time on."""
        self._shows += (real - self._real) * self._rate
        self._real, self.drift = real, drift

    @property
    def _rate(self) -> float:
        """Microseconds shown in a second."""
        return MICROSECONDS + self.drift
