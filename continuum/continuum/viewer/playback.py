"""A recording played on the page: play and pause, again and again or once, speed, and a slider over its time."""

from __future__ import annotations

import time

import numpy as np
import viser

from continuum.viewer.choice import Choice
from continuum.viewer.layout import Layout
from continuum.viewer.seen import Seen
from continuum.viewer.slider_value import value_within
from continuum.viewer.tracks import Tracks

_SPEEDS = {"1/8": 0.125, "1/4": 0.25, "1/2": 0.5, "1": 1.0, "2": 2.0, "4": 4.0}
_STEP = 0.01
"""Of the time slider [s]."""


class Playback:
    """Plays from the beginning as soon as somebody looks, again and again unless "Repeat" is off.

    Args:
        tracks: of the recording.
        name: of the recording.
    """

    def __init__(self, tracks: Tracks, name: str) -> None:
        self._tracks = tracks
        self._name = name
        self._time = 0.0
        self._asked: float | None = None

    def add_controls(self, layout: Layout) -> None:
        """Begin to play when somebody looks."""
        gui = layout.server.gui
        end = max(self._tracks.duration, _STEP)
        with layout.move:
            gui.add_markdown(f"`{self._name}`")
            self._plays: viser.GuiCheckboxHandle = gui.add_checkbox("Play", True)
            self._repeats: viser.GuiCheckboxHandle = gui.add_checkbox("Repeat", True)
            self._speed = Choice(layout, "Speed", tuple(_SPEEDS), "1")
            self._slider: viser.GuiSliderHandle[float] = gui.add_slider("time [s]", 0.0, end, min(_STEP, end), 0.0)
        self._shown = self._slider.value

    def newest(self) -> Seen:
        self._go()
        tracks, now = self._tracks, self._time
        target = tracks.target.at(now)
        return Seen(
            time=now,
            joints=tracks.joints.at(now),
            simulated=tracks.simulated.at(now),
            lengths=tracks.lengths.at(now),
            tensions=tracks.tensions.at(now),
            target=np.array([target[axis] for axis in "xyz"]) if target else None,
        )

    def _go(self) -> None:
        """Go on by the time since the last frame, or to where the slider was moved."""
        now = time.monotonic()
        passed, self._asked = 0.0 if self._asked is None else now - self._asked, now
        if self._slider.value != self._shown:
            self._time = value_within(self._slider)
        elif self._plays.value:
            end = self._tracks.duration
            if self._time >= end and self._shown >= end:
                self._time = 0.0  # it is repeated, or play was pressed at the end
            else:
                self._time = min(self._time + passed * _SPEEDS[self._speed.value], end)
                if self._time >= end and not self._repeats.value:
                    self._plays.value = False  # type: ignore[misc]
            self._slider.value = self._time  # type: ignore[misc]
        self._shown = self._slider.value
