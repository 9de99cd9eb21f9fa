"""The page without nodes and recording: its users move the arm."""

from __future__ import annotations

import time

import numpy as np

from continuum.arm import Arm
from continuum.viewer.layout import Layout
from continuum.viewer.posture_controls import PostureControls
from continuum.viewer.section_angles import joints_of
from continuum.viewer.seen import Seen


class ManualSource:
    """Source of an arm that sliders and a target move.

    Args:
        arm: arm.
    """

    def __init__(self, arm: Arm) -> None:
        self._arm = arm
        self._controls: PostureControls | None = None

    def add_controls(self, layout: Layout) -> None:
        self._controls = PostureControls(layout, self._arm)

    def newest(self) -> Seen:
        w = np.zeros((self._arm.n_sections, 2))
        if self._controls is not None:
            self._controls.follow()
            w = self._controls.w
        return Seen(time=time.monotonic(), joints=joints_of(w, self._arm))
