"""Recent path of a point, as a line."""

from __future__ import annotations

from collections import deque

import numpy as np
import viser

from continuum.arrays import Array
from continuum.cable_colours import Colour

_POINTS = 400
_LEAP = 50.0
"""Distance in steps beyond which a point has jumped, and its line starts again."""


class Trail:
    """A line that follows a point.

    Args:
        server: server of the page.
        name: name of the line in the scene.
        colour: colour of the line.
        step: smallest distance between points of the line [m].
        thickness: thickness of the line [m].
    """

    def __init__(self, server: viser.ViserServer, name: str, colour: Colour, step: float, thickness: float) -> None:
        self._points: deque[Array] = deque(maxlen=_POINTS)
        self._step = step
        self._line = server.scene.add_line_segments(
            name, np.zeros((1, 2, 3)), np.array(colour), thickness=thickness, visible=False
        )

    def follow(self, point: Array) -> None:
        """Extend the line to ``point``, (3,) [m]."""
        way = np.linalg.norm(point - self._points[-1]) if self._points else 0.0
        if self._points and way < self._step:
            return
        if way > _LEAP * self._step:
            self.clear()
        self._points.append(point.copy())
        if len(self._points) > 1:
            points = np.array(self._points, dtype=np.float32)
            self._line.points = np.stack([points[:-1], points[1:]], axis=1)
            self._line.visible = True

    def clear(self) -> None:
        """Clear the line."""
        self._points.clear()
        self._line.visible = False
