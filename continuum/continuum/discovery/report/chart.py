"""A chart as paths and ticks of an SVG, which templates/chart.html draws.

The page sets the colours, so that they follow its light or dark mode.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from matplotlib.path import Path
from matplotlib.ticker import MaxNLocator

from continuum.arrays import Array

_LEFT, _RIGHT, _TOP, _BOTTOM = 42.0, 8.0, 20.0, 34.0
"""Margins for the ticks' numbers, title and axis [px]."""
_SEEN = 0.3
"""Largest deviation of a simplified line from its points [px]: less than its width."""
_ROOM = 0.06
"""Fraction of an axis that is left free beyond the data."""
_SAME = 1e-9
"""Relative difference below which values count as equal on a scale: computed floats are no more accurate."""

type Limits = tuple[float, float]


@dataclass(frozen=True)
class Line:
    """A curve.

    Attributes:
        style: class of the page's style sheet.
        x, y: points, (n,) each, in the axes' units; NaN leaves a gap.
    """

    style: str
    x: Array
    y: Array


@dataclass(frozen=True)
class Axes:
    """What is drawn in one pair of axes.

    Attributes:
        title: text above the axes.
        x_label: text below the axes.
        lines: curves, the topmost last.
        band: half-width of a band around zero; 0 for none.
        x, y: limits; those of the data if None.
    """

    title: str
    x_label: str
    lines: tuple[Line, ...]
    band: float = 0.0
    x: Limits | None = None
    y: Limits | None = None


class Tick(NamedTuple):
    """Position of a tick [px], and its number."""

    at: float
    text: str


@dataclass(frozen=True)
class Chart:
    """A chart in pixels from the upper left corner.

    Attributes:
        width, height: size of the chart.
        left, right, top, bottom: edges of the axes.
        zero: position of y = 0; None if outside.
        band: upper end and height of the band; None if there is none.
    """

    title: str
    x_label: str
    width: float
    height: float
    left: float
    right: float
    top: float
    bottom: float
    x_ticks: tuple[Tick, ...]
    y_ticks: tuple[Tick, ...]
    zero: float | None
    band: tuple[float, float] | None
    paths: tuple[tuple[str, str], ...]


def chart(axes: Axes, width: float = 320.0, height: float = 150.0) -> Chart:
    """Convert axes to pixels."""
    left, right, top, bottom = _LEFT, width - _RIGHT, _TOP, height - _BOTTOM
    x_limits, y_limits = axes.x or limits([line.x for line in axes.lines], 0.0), axes.y or y_limits_of([axes])
    along = _Scale(x_limits, (left, right))
    up = _Scale(y_limits, (bottom, top))
    band = up.at(min(axes.band, y_limits[1])), up.at(max(-axes.band, y_limits[0]))
    return Chart(
        axes.title, axes.x_label, width, height, left, right, top, bottom,
        along.ticks(6), up.ticks(4),
        up.at(0.0) if y_limits[0] < 0 < y_limits[1] else None,
        (band[0], round(band[1] - band[0], 1)) if axes.band > 0 else None,
        tuple((line.style, _path(along(line.x), up(line.y))) for line in axes.lines),
    )  # fmt: skip


def shared(several: Sequence[Axes]) -> list[Axes]:
    """Return the same axes with one scale for all."""
    x, y = limits([line.x for one in several for line in one.lines], 0.0), y_limits_of(several)
    return [replace(one, x=x, y=y) for one in several]


def y_limits_of(several: Sequence[Axes]) -> Limits:
    """Return limits that contain all lines and bands."""
    bands = [np.array([-one.band, one.band]) for one in several if one.band > 0]
    return limits([*(line.y for one in several for line in one.lines), *bands], _ROOM)


def limits(values: Sequence[Array], room: float) -> Limits:
    """Return the least and the largest finite value, extended by a fraction of the range on each side."""
    every = np.concatenate([np.ravel(one) for one in values]) if values else np.zeros(0)
    every = every[np.isfinite(every)]
    if not every.size:
        return -1.0, 1.0
    low, high = float(every.min()), float(every.max())
    most = max(abs(low), abs(high))
    if high - low <= _SAME * max(most, 1.0):
        half = 0.5 * most if most > _SAME else 0.5
        return low - half, high + half
    free = room * (high - low)
    return low - free, high + free


class _Scale(NamedTuple):
    """Scale from the axes' units to pixels."""

    limits: Limits
    pixels: Limits

    def __call__(self, values: Array) -> Array:
        (low, high), (first, last) = self.limits, self.pixels
        return first + (values - low) * ((last - first) / (high - low))

    def at(self, value: float) -> float:
        """Return the position of a value, to a tenth of a pixel."""
        return round(float(self(np.asarray(value))), 1)

    def ticks(self, most: int) -> tuple[Tick, ...]:
        """Return ticks at round numbers."""
        places = MaxNLocator(most, steps=[1, 2, 5, 10]).tick_values(*self.limits)
        step = min((b - a for a, b in itertools.pairwise(places)), default=1.0)
        decimals = max(0, -int(np.floor(np.log10(step) + 1e-9)))
        inside = [float(place) for place in places if self.limits[0] <= place <= self.limits[1]]
        return tuple(Tick(self.at(place), _text(place, decimals)) for place in inside)


def _text(value: float, decimals: int) -> str:
    return f"{value:.{decimals}f}".replace("-", "−") if round(value, decimals) else "0"


def _path(x: Array, y: Array) -> str:
    """Return an SVG path with fewer points where these are nearly in line, and a new piece after every gap."""
    if not np.any(np.isfinite(x + y)):
        return ""
    path = Path(np.column_stack([x, y]))
    path.simplify_threshold = _SEEN
    seen = path.cleaned(remove_nans=True, simplify=True)
    letters = {Path.MOVETO: "M", Path.LINETO: "L"}
    points = zip(np.asarray(seen.codes), np.asarray(seen.vertices), strict=True)
    return "".join(f"{letters[code]}{x:.1f} {y:.1f}" for code, (x, y) in points if code in letters)
