"""A small plot of lines over time, with a legend, and a cursor at the shown instant."""

from __future__ import annotations

import numpy as np
import viser
from viser import uplot

from continuum.arrays import Array
from continuum.viewer.layout import Layout
from continuum.viewer.plot_data import PlotData
from continuum.viewer.screen_colours import css

_PADDING = (8, 16, 0, 0)
"""Above, right, below, left, so that the uppermost number is not cut off [pixels]."""

_LABEL, _TIME, _TICK = 16, 24, 4
"""Heights of the label and of the numbers of the time axis, and length of a tick [pixels]."""

_NUMBERS = 54
"""Width of the numbers of the other axis [pixels]: that of `-1000`."""

_BETWEEN = 20
"""Smallest distance between numbers of that axis [pixels], such that a low plot has several."""

_NUDGE = 1e-9
"""Relative extension of the time axis in every second drawing: the browser numbers an axis only when it changes, and
may have received the plot before its panel had a width. Plots without a cursor change over time anyway."""

_CURSOR = "rgb(128, 128, 128)"
_BELOW, _ABOVE = -1.0, 2.0
"""Ends of the cursor line, below and above its axis, which spans 0 to 1."""


class LinePlot:
    """One plot, absent while it has no line. Lines end at NaN; the browser then needs the range of values.

    Args:
        layout: page.
        title: title of the plot.
        order: position among the plots, independent of the order of creation.
        height: height of its area with the time axis [pixels].
        time_label: label of the time axis.
    """

    def __init__(self, layout: Layout, title: str, order: float, height: int, time_label: str) -> None:
        self._layout, self._title, self._order, self._height = layout, title, order, height
        self._time_label = time_label
        self._made_of: tuple[object, ...] = ()
        self._is_nudged = False
        self.plot: viser.GuiUplotHandle | None = None

    def show(self, data: PlotData | None, now: float | None = None, dark: bool = False) -> None:
        """Draw the lines, with a cursor at ``now`` [s] if given."""
        if data is None or len(data.times) < 2:  # one point is not a line, and its axes would be meaningless
            self.remove()
            return
        made_of = (data.lines, dark, now is None, range_of(data.values))
        arrays = (data.times, *data.values)
        if now is not None:
            times, *lines = with_cursor(data, now)
            arrays = (self._nudged(times), *lines)
        if self.plot is None or made_of != self._made_of:
            self.remove()
            self._made_of = made_of
            self.plot = self._made(arrays, data, dark, now is not None)
        else:
            self.plot.data = arrays

    def remove(self) -> None:
        """Remove the plot from the page; the next data restore it."""
        if self.plot is not None:
            self.plot.remove()
        self.plot, self._made_of = None, ()

    def _nudged(self, times: Array) -> Array:
        self._is_nudged = not self._is_nudged
        nudged = times.copy()
        nudged[-1] += _NUDGE * (times[-1] - times[0]) * self._is_nudged
        return nudged

    def _made(self, arrays: tuple[Array, ...], data: PlotData, dark: bool, cursor: bool) -> viser.GuiUplotHandle:
        no_points = uplot.Series_Points(show=False)
        series = [
            uplot.Series(label=line.label, stroke=css(line.colour, dark), width=2, points=no_points)
            for line in data.lines
        ]
        scales = {"x": uplot.Scale(time=False, auto=True)}
        if (ends := range_of(data.values)) is not None:
            scales["y"] = uplot.Scale(auto=False, range=ends)
        if cursor:
            series.append(uplot.Series(label="cursor", scale="cursor", stroke=_CURSOR, width=1, points=no_points))
            scales["cursor"] = uplot.Scale(auto=False, range=(0.0, 1.0))
        ticks = uplot.Axis_Ticks(size=_TICK)
        with self._layout.plots:
            return self._layout.server.gui.add_uplot(
                arrays,
                (uplot.Series(label="t [s]"), *series),
                title=self._title,
                height=self._height,
                padding=_PADDING,
                axes=(
                    uplot.Axis(label=self._time_label, labelSize=_LABEL, size=_TIME, ticks=ticks),
                    uplot.Axis(size=_NUMBERS, space=_BETWEEN, ticks=ticks),
                ),
                legend=uplot.Legend(show=True, live=False),
                scales=scales,
                order=self._order,
            )


def range_of(values: Array) -> tuple[float, float] | None:
    """Return the range of the axis of lines with NaN, (n_lines, n); None without NaN, where the browser finds it.

    The ends are rounded, so that a plot over the last seconds is not made again for each instant.
    """
    if np.isfinite(values).all():
        return None
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    step = 10.0 ** np.floor(np.log10(high - low)) if high > low else 1.0
    return float(step * (np.ceil(low / step) - 1)), float(step * (np.floor(high / step) + 1))


def with_cursor(data: PlotData, now: float) -> tuple[Array, ...]:
    """Return times, lines and a vertical cursor at ``now`` [s], (n_times + 3,) each; the lines do not change."""
    times, values = data.times, data.values
    row = int(np.searchsorted(times, now))
    between = np.array([[np.interp(now, times, line)] * 3 for line in values]).reshape(len(values), 3)
    cursor = np.full(len(times) + 3, _BELOW)
    cursor[row + 1] = _ABOVE
    return (np.insert(times, row, [now] * 3), *np.insert(values, [row] * 3, between, axis=1), cursor)
