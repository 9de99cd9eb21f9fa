"""From the device's clock to the host's, without the jitter of the way between.

A frame of device time t that is heard at host time r has been under way for r - (offset + (1 + drift) t) >= 0, and now
and then hardly at all. So the line sought lies under all points (t, r - t) and as close to them as it can: of all such
lines the one with the least sum of distances is the edge of the points' lower convex hull above which their mean stands
(L. Zhang, Z. Liu, C. H. Xia, Clock synchronization algorithms for network measurements, IEEE INFOCOM 2002). Late frames
lie above it and change nothing, however many they are.

The shortest way itself cannot be seen from one side: it stays in the offset, a millisecond on a serial port.
"""

from __future__ import annotations

from collections import deque
from itertools import pairwise

from continuum_hw_imu.protocol.device_time import MICROSECONDS

Point = tuple[float, float]

_BUCKET = 0.25
"""Of each stretch of this length [s] the least delayed frame counts."""

_SETTLING = 4.0
"""Of a shorter time no drift is told [s]."""

_LEAP = 0.05
"""Frames that come earlier than they can by more than this mean that a clock was set [s]."""


class ClockMap:
    """Learns from every frame. Device times [us] unwrapped; host times [s] of a clock that is never set.

    Args:
        window: what is further back is forgotten [s].
        most_drift: no clock drifts faster; a quartz is within 1e-4.

    Attributes:
        drift: of the device's clock against the host's, positive where the device's is slow; 0 until it is known.
        leaps: how often a clock was set.
    """

    def __init__(self, window: float = 20.0, most_drift: float = 1e-3) -> None:
        self._most_drift = most_drift
        self._points: deque[Point] = deque()
        self._window = window
        self.leaps = 0
        self.forget()

    def forget(self) -> None:
        """The device began anew."""
        self._points.clear()
        self._origin: int | None = None
        self._offset = 0.0
        self.drift = 0.0

    @property
    def known(self) -> bool:
        """Whether any frame was heard."""
        return self._origin is not None

    def received(self, device: int, host: float) -> None:
        """A frame of a device time came at a host time."""
        if self._origin is not None and host - self.host_time(device) < -_LEAP:
            self.leaps += 1
            self.forget()
        if self._origin is None:
            self._origin = device
            self._offset = host
        t = (device - self._origin) / MICROSECONDS
        point = (t, host - t)
        if self._points and t < (_bucket(self._points[-1][0]) + 1) * _BUCKET:
            if point[1] >= self._points[-1][1] or _bucket(t) != _bucket(self._points[-1][0]):
                return  # not the least delayed of its stretch, or late
            self._points[-1] = point
        else:
            self._points.append(point)
        self._fit()

    def host_time(self, device: int) -> float:
        """When it was ``device`` [us] there, by the host's clock [s]; only once `known`."""
        t = (device - (self._origin or 0)) / MICROSECONDS
        return self._offset + (1.0 + self.drift) * t

    def device_time(self, host: float) -> int:
        """What the device's clock shows [us] at a host time [s]; only once `known`."""
        return (self._origin or 0) + round((host - self._offset) / (1.0 + self.drift) * MICROSECONDS)

    def _fit(self) -> None:
        while self._points[0][0] < self._points[-1][0] - self._window:
            self._points.popleft()
        points = list(self._points)
        if points[-1][0] - points[0][0] >= _SETTLING:
            slope = _slope_below(points)
            self.drift = min(max(slope, -self._most_drift), self._most_drift)
        self._offset = min(y - self.drift * t for t, y in points)


def _bucket(t: float) -> int:
    return int(t // _BUCKET)


def _slope_below(points: list[Point]) -> float:
    """Of the lower convex hull's edge under the points' mean; points from left to right, two at least."""
    hull: list[Point] = []
    for point in points:
        while len(hull) > 1 and not _turns_left(hull[-2], hull[-1], point):
            hull.pop()
        hull.append(point)
    mean = sum(t for t, _ in points) / len(points)
    (t_0, y_0), (t_1, y_1) = next(edge for edge in pairwise(hull) if edge[1][0] >= mean)
    return (y_1 - y_0) / (t_1 - t_0)


def _turns_left(a: Point, b: Point, c: Point) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
