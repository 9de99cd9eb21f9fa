"""Plots of one section, chosen on the page: one small plot for each joint, and plots of its cables."""

from __future__ import annotations

import time
from collections.abc import Mapping

from continuum.arm import Arm, Section
from continuum.viewer.choice import Choice
from continuum.viewer.layout import Layout, spoken
from continuum.viewer.line_plot import LinePlot
from continuum.viewer.plot_data import LENGTHS, PHI, TENSIONS, THETA, PlotData

PERIOD = 0.2
"""Shortest time between two drawings [s]."""

_LOW, _HIGH = 104, 190
"""Heights of a plot of one joint and of a plot of several cables [pixels]."""

_PLACES = {THETA: 1.0, PHI: 3.0, LENGTHS: 4.0, TENSIONS: 5.0}
_JOINTS = 2.0
_MOST_JOINTS = 1000
"""Positions among the plots; those of joints are from 2 to 3."""


class SectionPlots:
    """Plots in the panel of plots.

    Args:
        layout: page.
        arm: arm.
        time_label: label of the time axes.
    """

    def __init__(self, layout: Layout, arm: Arm, time_label: str) -> None:
        self._layout, self._time_label = layout, time_label
        self._sections = {spoken(section.name): section for section in arm.sections}
        self._due = 0.0
        self._plots: dict[str, LinePlot] = {}
        with layout.plots:
            self.choice = Choice(layout, "Section", tuple(self._sections), visible=arm.n_sections > 1, order=0.0)

    @property
    def section(self) -> Section:
        """The section that is plotted."""
        return self._sections[self.choice.value]

    def are_due(self) -> bool:
        """Return whether a drawing is due; the next one is due after `PERIOD`."""
        if time.monotonic() < self._due:
            return False
        self._due = time.monotonic() + PERIOD
        return True

    def draw_soon(self) -> None:
        """Make the next drawing due."""
        self._due = 0.0

    def plot(self, title: str) -> LinePlot | None:
        """Return the plot with this title, None if it has never had data."""
        return self._plots.get(title)

    def show(self, data: Mapping[str, PlotData], now: float | None = None, dark: bool = False) -> None:
        """Draw the plots by title, with a cursor at ``now`` [s] if given, and remove all others."""
        for number, title in enumerate(data):
            if title not in self._plots:
                order = _PLACES.get(title, _JOINTS + number / _MOST_JOINTS)
                height = _HIGH if title in (LENGTHS, TENSIONS) else _LOW
                self._plots[title] = LinePlot(self._layout, title, order, height, self._time_label)
        for title, plot in self._plots.items():
            plot.show(data.get(title), now, dark)
