"""Small plots of cables over the last seconds: the lengths and tensions of one section's cables."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Mapping, Sequence

import numpy as np
import viser
from viser import uplot

from continuum.arm import Arm, Section
from continuum.arrays import Array
from continuum.cable_colours import cable_colour
from continuum.viewer.choice import Choice
from continuum.viewer.layout import Layout, spoken
from continuum.viewer.seen import Seen

SPAN = 20.0
"""What the plots reach back [s]."""

_STEP = 0.05
"""Shortest time between two points [s]."""

_GAP = 5.0
"""Longest time between two points that a line joins [s]."""

_PERIOD = 0.2
"""Shortest time between two drawings, by the machine's clock [s]."""

_HEIGHT = 210
_PADDING = (10, 24, 0, 0)
"""Above, right, below, left, so that the uppermost number is whole [pixels]."""

_LABEL, _TICKS = 18, 34
"""Heights of the time axis' label, and of its numbers [pixels]."""


class CablePlots:
    """Plots of lengths [mm] and tensions [N] on the page's panel of cables.

    Args:
        layout: of the page.
        arm: the arm.
    """

    def __init__(self, layout: Layout, arm: Arm) -> None:
        self._sections = {spoken(section.name): section for section in arm.sections}
        self._rows: deque[tuple[float, dict[str, float], dict[str, float]]] = deque()
        with layout.cables:
            self._choice = Choice(layout, "Section", tuple(self._sections), visible=arm.n_sections > 1, order=0.0)
        self._due = 0.0
        self._lengths = CablePlot(layout, "Cable lengths [mm]", 1e3, order=1.0)
        self._tensions = CablePlot(layout, "Cable tensions [N]", 1.0, order=2.0)

    def show(self, seen: Seen) -> None:
        """Take the instant in, and draw where it is time to."""
        if self._rows and not 0.0 <= seen.time - self._rows[-1][0] <= _GAP:
            self._rows.clear()  # another run, or the time slider was moved: no line over what was not seen
        if not self._rows or seen.time - self._rows[-1][0] >= _STEP:
            self._rows.append((seen.time, dict(seen.lengths), dict(seen.tensions)))
        while self._rows[0][0] < seen.time - SPAN:
            self._rows.popleft()
        if time.monotonic() < self._due:
            return
        self._due = time.monotonic() + _PERIOD
        section = self._sections[self._choice.value]
        times = np.array([row[0] for row in self._rows]) - self._rows[-1][0]
        self._lengths.show(section, times, [row[1] for row in self._rows])
        self._tensions.show(section, times, [row[2] for row in self._rows])


class CablePlot:
    """One quantity of those cables of a section of which it is known; no plot while it is of none.

    The page's plots draw nothing at all where one number of one line is missing.

    Args:
        layout: of the page.
        title: of the plot.
        factor: to the plot's unit.
        order: where it stands among the plots, whenever it is made.
    """

    def __init__(self, layout: Layout, title: str, factor: float, order: float) -> None:
        self._layout = layout
        self._title = title
        self._factor = factor
        self._order = order
        self._cables: tuple[str, ...] = ()
        self.plot: viser.GuiUplotHandle | None = None

    def show(self, section: Section, times: Array, rows: Sequence[Mapping[str, float]]) -> None:
        """Draw what is known of the newest row's cables, (n_rows,) [s], by name."""
        known = tuple(name for name in section.cable_names if name in rows[-1])
        if known != self._cables:
            if self.plot is not None:
                self.plot.remove()
            self._cables = known
            self.plot = self._made(section) if known else None
        if self.plot is not None:
            whole = [i for i, row in enumerate(rows) if all(name in row for name in known)]
            values = self._factor * np.array([[rows[i][name] for i in whole] for name in known])
            self.plot.data = (times[whole], *values)
            self.plot.visible = len(whole) > 1  # one point is no line, and its axes would mean nothing

    def _made(self, section: Section) -> viser.GuiUplotHandle:
        numbers = [section.cable_names.index(name) for name in self._cables]
        lines = [
            uplot.Series(label=f"cable {j + 1}", stroke=_css(j), width=2, points=uplot.Series_Points(show=False))
            for j in numbers
        ]
        with self._layout.cables:
            return self._layout.server.gui.add_uplot(
                tuple(np.zeros(1) for _ in range(1 + len(lines))),
                (uplot.Series(label="t [s]"), *lines),
                title=self._title,
                height=_HEIGHT,
                padding=_PADDING,
                axes=(uplot.Axis(label="time [s], now is 0", labelSize=_LABEL, size=_TICKS), uplot.Axis()),
                legend=uplot.Legend(show=False),
                scales={"x": uplot.Scale(time=False, auto=True)},
                order=self._order,
            )


def _css(number: int) -> str:
    return "rgb({:.0f}, {:.0f}, {:.0f})".format(*(255 * part for part in cable_colour(number)))
