"""Plots of a whole recording, with a cursor at the current instant."""

from __future__ import annotations

from collections.abc import Sequence

from continuum.arm import Arm
from continuum.viewer.layout import Layout
from continuum.viewer.plot_data import Motion, PlotData, padded, section_data, thinned
from continuum.viewer.section_plots import SectionPlots
from continuum.viewer.tracks import Track

_TIME = "time [s]"

_MOST = 400
"""Largest number of points of a line; a plot is about 230 pixels wide."""


class RecordedPlots:
    """Plots of a recording, which replace those over the last seconds.

    Args:
        layout: page.
        arm: arm.
        motions: motions to compare.
        lengths: lengths of cables [m].
        tensions: tensions of cables [N].

    Attributes:
        plots: the plots on the page.
    """

    def __init__(self, layout: Layout, arm: Arm, motions: Sequence[Motion], lengths: Track, tensions: Track) -> None:
        self._motions, self._lengths, self._tensions = motions, lengths, tensions
        self.plots = SectionPlots(layout, arm, _TIME)
        self._end = max(float(motion.joints.times[-1]) for motion in motions)
        self._data: dict[str, dict[str, PlotData]] = {}

    def show(self, now: float, dark: bool = False) -> None:
        """Move the cursor to ``now`` [s] if a drawing is due."""
        if not self.plots.are_due():
            return
        section = self.plots.section
        if section.name not in self._data:
            whole = section_data(section, self._motions, self._lengths, self._tensions)
            self._data[section.name] = {title: padded(thinned(data, _MOST), self._end) for title, data in whole.items()}
        self.plots.show(self._data[section.name], now, dark)
