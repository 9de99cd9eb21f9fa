"""Plots over the last seconds, of an arm that nodes or a user of the page moves."""

from __future__ import annotations

from collections import deque

import numpy as np

from continuum.arm import Arm
from continuum.viewer.layout import Layout
from continuum.viewer.overlay_colours import GHOST, SOLID
from continuum.viewer.plot_data import Motion, section_data, track_of
from continuum.viewer.section_plots import SectionPlots
from continuum.viewer.seen import Seen

SPAN = 20.0
"""Duration that the plots show [s]."""

_STEP = 0.05
"""Shortest time between two points [s]."""

_GAP = 5.0
"""Longest time between two points that a line joins [s]."""

_TIME = "time [s], now is 0"


class LivePlots:
    """Plots of joint angles, cable lengths and tensions.

    Args:
        layout: page.
        arm: arm.

    Attributes:
        plots: the plots on the page.
    """

    def __init__(self, layout: Layout, arm: Arm) -> None:
        self.plots = SectionPlots(layout, arm, _TIME)
        self._instants: deque[Seen] = deque()

    def show(self, seen: Seen, dark: bool = False) -> None:
        """Add an instant, and draw if a drawing is due."""
        instants = self._instants
        if instants and not 0.0 <= seen.time - instants[-1].time <= _GAP:
            instants.clear()  # another run: no line across the gap
        if not instants or seen.time - instants[-1].time >= _STEP:
            instants.append(seen)
        while instants[0].time < seen.time - SPAN:
            instants.popleft()
        if not self.plots.are_due():
            return
        times = np.array([one.time for one in instants]) - instants[-1].time
        section = self.plots.section
        joints, simulated = (
            track_of(times, [getattr(one, field) for one in instants], (*section.theta_joints, section.phi_joint))
            for field in ("joints", "simulated")
        )
        lengths, tensions = (
            track_of(times, [getattr(one, field) for one in instants], section.cable_names)
            for field in ("lengths", "tensions")
        )
        motions = [Motion("", joints, SOLID)]
        if simulated.names:
            motions = [Motion("simulated", simulated, SOLID), Motion("measured", joints, GHOST)]
        self.plots.show(section_data(section, motions, lengths, tensions), dark=dark)
