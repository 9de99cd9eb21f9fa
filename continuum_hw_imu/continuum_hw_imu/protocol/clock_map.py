"""Map from the device's clock to the host's, without the jitter of the transmission.

A frame with device time t that arrives at host time r has a delay r - (offset + (1 + drift) t) >= 0, which is
occasionally close to zero. The line sought is therefore below all points (t, r - t) and as close to them as possible:
of all such lines, the one with the least sum of distances is the edge of the points' lower convex hull below their mean
(L. Zhang, Z. Liu, C. H. Xia, Clock synchronization algorithms for network measurements, IEEE INFOCOM 2002). Any number
of late frames lie above it and do not change it.

The shortest delay cannot be determined from one side: it remains in the offset, a millisecond on a serial port, and
more if every frame so far was late. Answers limit it from the other side: a device answers no request before it was
sent. So at a frame that arrives at r the map is at most r - host_time early, at an answer to a request of the time s at
most host_time - s late, and from there on it goes wrong no faster than its drift and the true one may differ.
"""

from __future__ import annotations

import math
from collections import deque
from itertools import pairwise

from continuum_hw_imu.protocol.device_time import MICROSECONDS

Point = tuple[float, float]

_Limit = tuple[int, float]
"""Device time [us] and a host time [s] that it cannot be later than, or earlier than."""

_BUCKET = 0.25
"""Length of an interval [s] of which the least delayed frame counts."""

_SETTLING = 4.0
"""Shortest time from which a drift is estimated [s]."""

_LEAP = 0.05
"""Before any answer, frames that arrive earlier than possible by more than this indicate that a clock was set [s]."""

_ROUNDING = 1e-5
"""Error of times by rounding, to 1 us on the line [s]."""


class ClockMap:
    """Clock map that every frame updates; device times [us] are unwrapped, host times [s] monotonic.

    Args:
        window: length of the history that is used [s].
        most_drift: largest possible drift: two quartzes of 1e-4 each, and 5e-4 by which NTP may slew the host's clock.

    Attributes:
        drift: drift of the device's clock relative to the host's, positive if the device's is slow; 0 until known.
        leaps: number of times that a clock was set.
    """

    def __init__(self, window: float = 20.0, most_drift: float = 7e-4) -> None:
        self._most_drift = most_drift
        self._points: deque[Point] = deque()
        self._window = window
        self.leaps = 0
        self.forget()

    def forget(self) -> None:
        """Start over after a restart of the device."""
        self._points.clear()
        self._origin: int | None = None
        self._latest: _Limit | None = None
        self._earliest: _Limit | None = None
        self._offset = 0.0
        self.drift = 0.0

    @property
    def known(self) -> bool:
        """Whether any frame has arrived."""
        return self._origin is not None

    def received(self, device: int, host: float, asked: float | None = None) -> None:
        """Process a frame with a device time that arrived at a host time.

        For an answer, ``asked`` is the host time at which its request was sent.
        """
        if self._origin is not None and self._is_impossible(device, host, asked):
            self.leaps += 1
            self.forget()
        if self._origin is None:
            self._origin = device
            self._offset = host
        self._add((device - self._origin) / MICROSECONDS, host)
        self._latest = self._closer(self._latest, (device, host))
        if asked is not None:
            self._earliest = self._closer(self._earliest, (device, asked))

    def _is_impossible(self, device: int, host: float, asked: float | None) -> bool:
        """Return whether a frame arrived earlier, or a request was sent later, than the map and its error allow."""
        mapped, error = self.host_time(device), self.error(device)
        if math.isinf(error):
            return host < mapped - _LEAP
        error += _ROUNDING
        return host < mapped - error or (asked is not None and asked > mapped + error)

    def _add(self, t: float, host: float) -> None:
        """Take a point into the history if it is the least delayed of its interval, and fit the line."""
        point = (t, host - t)
        if self._points and t < (_bucket(self._points[-1][0]) + 1) * _BUCKET:
            if point[1] >= self._points[-1][1] or _bucket(t) != _bucket(self._points[-1][0]):
                return
            self._points[-1] = point
        else:
            self._points.append(point)
        self._fit()

    def host_time(self, device: int) -> float:
        """Return the host time [s] of a device time [us]; only valid if `known`."""
        t = (device - (self._origin or 0)) / MICROSECONDS
        return self._offset + (1.0 + self.drift) * t

    def error(self, device: int) -> float:
        """Return the largest possible error of `host_time` at a device time [us], in s; infinite before any answer."""
        latest, earliest = self._latest, self._earliest  # another thread may forget them
        if latest is None or earliest is None:
            return math.inf
        return max(self._distance(latest, device), self._distance(earliest, device))

    def _distance(self, limit: _Limit, device: int) -> float:
        """Return how far the map may be beyond a limit, seen from a device time [us]; in s."""
        away = abs(device - limit[0]) / MICROSECONDS
        return abs(limit[1] - self.host_time(limit[0])) + (abs(self.drift) + self._most_drift) * away

    def _closer(self, kept: _Limit | None, new: _Limit) -> _Limit:
        """Return the limit that says more at the device time of the new one."""
        return kept if kept and self._distance(kept, new[0]) < self._distance(new, new[0]) else new

    def device_time(self, host: float) -> int:
        """Return the device time [us] at a host time [s]; only valid if `known`."""
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
    """Return the slope of the lower convex hull's edge below the mean of at least two points, from left to right."""
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
