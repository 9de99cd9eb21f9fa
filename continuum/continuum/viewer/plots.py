"""Small plots of cables over the last seconds: the lengths and tensions of one section's cables."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Mapping

import numpy as np
import viser
from viser import uplot

from continuum.arm import Arm, Section
from continuum.arrays import Array
from continuum.cable_colours import cable_colour
from continuum.viewer.layout import Layout
from continuum.viewer.seen import Seen

SPAN = 20.0
"""What the plots reach back [s]."""

_STEP = 0.05
"""Shortest time between two points [s]."""

_PERIOD = 0.2
"""Shortest time between two drawings, by the machine's clock [s]."""

_HEIGHT = 190


class CablePlots:
    """Plots of lengths [mm] and tensions [N] on the page's panel of cables.

    Args:
        layout: of the page.
        arm: the arm.
    """

    def __init__(self, layout: Layout, arm: Arm) -> None:
        self._sections = {section.name: section for section in arm.sections}
        self._rows: deque[tuple[float, dict[str, float], dict[str, float]]] = deque()
        self._layout = layout
        gui = layout.server.gui
        with layout.cables:
            self._choice = gui.add_dropdown("Section", tuple(self._sections), visible=arm.n_sections > 1)
        self._due = 0.0
        self._plotted = arm.sections[0]
        self._plots = self._make(self._plotted)

    def show(self, seen: Seen) -> None:
        """Take the instant in, and draw where it is time to."""
        if self._rows and seen.time < self._rows[-1][0]:
            self._rows.clear()  # another run, or the time slider was moved back
        if not self._rows or seen.time - self._rows[-1][0] >= _STEP:
            self._rows.append((seen.time, dict(seen.lengths), dict(seen.tensions)))
        while self._rows[0][0] < seen.time - SPAN:
            self._rows.popleft()
        if time.monotonic() < self._due:
            return
        self._due = time.monotonic() + _PERIOD
        if self._choice.value != self._plotted.name:
            for plot, _ in self._plots.values():
                plot.remove()
            self._plotted = self._sections[self._choice.value]
            self._plots = self._make(self._plotted)
        self._draw()

    def _draw(self) -> None:
        times = np.array([row[0] for row in self._rows]) - self._rows[-1][0]
        for column, (name, (plot, factor)) in enumerate(self._plots.items(), start=1):
            values = self._values([row[column] for row in self._rows])  # type: ignore[misc]
            known = bool(np.any(np.isfinite(values)))
            plot.visible = known or name == "lengths"
            if known:
                plot.data = (times, *(factor * values))

    def _values(self, rows: list[Mapping[str, float]]) -> Array:
        """(n_cables, n_rows), NaN where nothing is known."""
        return np.array([[row.get(cable, np.nan) for row in rows] for cable in self._plotted.cable_names])

    def _make(self, section: Section) -> dict[str, tuple[viser.GuiUplotHandle, float]]:
        empty = tuple(np.zeros(1) for _ in range(1 + len(section.cable_names)))
        series = (
            uplot.Series(label="t [s]"),
            *(
                uplot.Series(label=f"cable {j + 1}", stroke=_css(j), width=2, points=uplot.Series_Points(show=False))
                for j in range(len(section.cable_names))
            ),
        )
        made = {}
        for name, title, factor in (("lengths", "Cable lengths [mm]", 1e3), ("tensions", "Cable tensions [N]", 1.0)):
            with self._layout.cables:
                plot = self._layout.server.gui.add_uplot(
                    empty,
                    series,
                    title=title,
                    height=_HEIGHT,
                    legend=uplot.Legend(show=False),
                    scales={"x": uplot.Scale(time=False, auto=True)},
                )
            made[name] = (plot, factor)
        return made


def _css(number: int) -> str:
    return "rgb({:.0f}, {:.0f}, {:.0f})".format(*(255 * part for part in cable_colour(number)))
