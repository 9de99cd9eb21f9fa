"""A recording played on the page: play and pause, steps, again and again or once, speed, a slider over its time."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import viser

from continuum.arm import Arm
from continuum.viewer.choice import Choice
from continuum.viewer.drawn_cables import drawn_cables
from continuum.viewer.layout import Layout
from continuum.viewer.motion_csv import motion_csv
from continuum.viewer.motion_legend import motion_legend
from continuum.viewer.overlay_colours import GHOST, SOLID, overlay_colour
from continuum.viewer.plot_data import Motion
from continuum.viewer.recorded_plots import RecordedPlots
from continuum.viewer.seen import Seen
from continuum.viewer.slider_value import value_within
from continuum.viewer.tracks import Track, Tracks

_SPEEDS = {"1/8": 0.125, "1/4": 0.25, "1/2": 0.5, "1": 1.0, "2": 2.0, "4": 4.0}
_STEPS = {"back": -1, "forward": 1}
_STEP = 0.01
"""Of the time slider [s]."""


class Playback:
    """Plays from the beginning as soon as somebody looks, again and again unless "Repeat" is off.

    Args:
        arm: arm.
        tracks: tracks of the recording.
        name: name of the recording.
        overlays: joint angles of other motions of the same arm by name [rad]; they are drawn as ghosts.
        simulated: name of the simulated motion, if there is one.
    """

    def __init__(
        self, arm: Arm, tracks: Tracks, name: str, overlays: Mapping[str, Track] | None = None,
        simulated: str = "simulated",
    ) -> None:  # fmt: skip
        self._arm, self._tracks, self._name = arm, tracks, name
        self._overlays = dict(overlays or {})
        self._motions = self._all_motions(simulated)
        self._time = 0.0
        self._asked: float | None = None
        self._steps = 0

    def add_controls(self, layout: Layout) -> None:
        """Begin to play when somebody looks."""
        gui = layout.server.gui
        end = max(self._tracks.duration, _STEP)
        with layout.move:
            gui.add_markdown(f"`{self._name}`")
            if len(self._motions) > 1:
                gui.add_html(motion_legend([(motion.label, motion.colour) for motion in self._motions]))
            self._plays: viser.GuiCheckboxHandle = gui.add_checkbox("Play", True)
            self._repeats: viser.GuiCheckboxHandle = gui.add_checkbox("Repeat", True)
            self._speed = Choice(layout, "Speed", tuple(_SPEEDS), "1")
            self._slider: viser.GuiSliderHandle[float] = gui.add_slider("time [s]", 0.0, end, min(_STEP, end), 0.0)
            steps = gui.add_button_group("Step", tuple(_STEPS), hint="To the sample before or after; pauses.")
            save = gui.add_button("Save CSV", hint="Joint angles, tip and cables of the motion that is drawn solid.")
        layout.words.update(_STEPS)
        steps.on_click(self._step)
        save.on_click(self._save)
        self._shown = self._slider.value
        solid, tracks = self._motions[0].joints, self._tracks
        self._lengths = tracks.lengths if tracks.lengths.times.size else drawn_cables(solid, self._arm)
        self._plots = RecordedPlots(layout, self._arm, self._motions, self._lengths, tracks.tensions)

    def newest(self) -> Seen:
        self._go()
        tracks, now = self._tracks, self._time
        target = tracks.target.at(now)
        return Seen(
            time=now,
            joints=tracks.joints.at(now),
            simulated=tracks.simulated.at(now),
            overlays=tuple(track.at(now) for track in self._overlays.values()),
            lengths=self._lengths.at(now),
            tensions=tracks.tensions.at(now),
            target=np.array([target[axis] for axis in "xyz"]) if target else None,
            plots=self._plots,
        )

    def _all_motions(self, simulated: str) -> Sequence[Motion]:
        """All motions, the one that is drawn solid first."""
        tracks = self._tracks
        overlays = [Motion(name, t, overlay_colour(i)) for i, (name, t) in enumerate(self._overlays.items())]
        if not tracks.simulated.times.size:
            return [Motion(self._name, tracks.joints, SOLID), *overlays]
        return [Motion(simulated, tracks.simulated, SOLID), Motion("measured", tracks.joints, GHOST), *overlays]

    def _go(self) -> None:
        """Go on by the time since the last frame, or to where the slider was moved, or by single samples."""
        now = time.monotonic()
        passed, self._asked = 0.0 if self._asked is None else now - self._asked, now
        steps, self._steps = self._steps, 0
        if self._slider.value != self._shown:
            self._time = value_within(self._slider)
        elif steps:
            self._plays.value = False  # type: ignore[misc]
            times = self._tracks.joints.times
            row = int(np.searchsorted(times, self._time, side="right")) - 1 + steps
            self._time = float(times[min(max(row, 0), times.size - 1)])
            self._slider.value = self._time  # type: ignore[misc]
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

    def _step(self, event: viser.GuiEvent[Any]) -> None:
        self._steps += _STEPS.get(event.target.value, 0)

    def _save(self, event: viser.GuiEvent[Any]) -> None:
        if event.client is not None:
            content = motion_csv(self._motions[0].joints, self._lengths, self._tracks.tensions, self._arm)
            event.client.send_file_download("motion.csv", content.encode(), save_immediately=True)
