"""The clock of the emulated controller: derived from the machine's clock, with an adjustable drift."""

from __future__ import annotations

from continuum_hw_imu.protocol.device_time import MICROSECONDS


class DeviceClock:
    """Conversion between unwrapped device times [us] and real times [s] of a monotonic clock.

    Args:
        real: the present real time.
        shows: reading of the clock at that time [us].
        drift: relative error of its rate in parts per million, positive if it is fast; also an attribute.
    """

    def __init__(self, real: float, shows: int = 0, drift: float = 0.0) -> None:
        self._real, self._shows = real, float(shows)
        self.drift = drift

    def at(self, real: float) -> int:
        """Return the reading at a real time."""
        return round(self._shows + (real - self._real) * self._rate)

    def real(self, shows: float) -> float:
        """Return the real time of a reading."""
        return self._real + (shows - self._shows) / self._rate

    def drift_from(self, real: float, drift: float) -> None:
        """Change the drift from a real time on."""
        self._shows += (real - self._real) * self._rate
        self._real, self.drift = real, drift

    @property
    def _rate(self) -> float:
        """Device microseconds per second of real time."""
        return MICROSECONDS + self.drift
