"""Time of a recording: play and pause, single steps, repetition, speed, and a slider."""

from __future__ import annotations

import math
import time
from queue import SimpleQueue
from typing import Any

import numpy as np
import viser

from continuum.arrays import Array
from continuum.viewer.choice import Choice
from continuum.viewer.layout import Layout
from continuum.viewer.slider_value import value_within

_SPEEDS = {"1/8": 0.125, "1/4": 0.25, "1/2": 0.5, "1": 1.0, "2": 2.0, "4": 4.0}
_STEPS = {"back": -1, "forward": 1}
_STEP = 0.01
"""Step of the time slider [s]."""

_DIGITS = 3
"""Decimal places of its number, few enough to be shown in full."""


class Player:
    """Controls on the page, shared by all browsers. Playback starts at the first call of `go_on`.

    The keys are space, J and L; the page uses WASD, Q, E and the arrows for its camera.

    Args:
        layout: page; the controls are put into the container that is open.
        times: times of the samples to step over, increasing from 0, (n,) [s].

    Attributes:
        playing: whether the time advances.
    """

    def __init__(self, layout: Layout, times: Array) -> None:
        self._times, self._time, self._end = times, 0.0, float(times[-1])
        self._asked: float | None = None
        self._steps: SimpleQueue[int] = SimpleQueue()  # keys arrive in the thread of the event loop
        self.playing, self._said_playing = True, False
        gui = layout.server.gui
        last = _STEP * max(math.ceil(round(self._end / _STEP, 6)), 1)
        self._button = gui.add_button("Play", hint="Key: space")
        steps = gui.add_button_group("Step", tuple(_STEPS), hint="To the previous or next sample. Keys: J, L")
        self._slider: viser.GuiSliderHandle[float] = gui.add_slider("time [s]", 0.0, round(last, 2), _STEP, 0.0)
        self._speed = Choice(layout, "Speed", tuple(_SPEEDS), "1")
        self._repeats: viser.GuiCheckboxHandle = gui.add_checkbox("Repeat", True)
        layout.words.update(_STEPS)
        self._shown = self._slider.value
        self._button.on_click(self._toggle)
        steps.on_click(self._step)
        gui.add_command("Play or pause", hotkey="space").on_trigger(self._toggle)
        gui.add_command("Step back", hotkey="J").on_trigger(self._step_back)
        gui.add_command("Step forward", hotkey="L").on_trigger(self._step_forward)
        self._say()

    def go_on(self) -> float:
        """Return the time [s]: advanced by the time since the last call, or as set by the user."""
        now = time.monotonic()
        passed, self._asked = 0.0 if self._asked is None else now - self._asked, now
        steps = sum(self._steps.get() for _ in range(self._steps.qsize()))
        if self._slider.value != self._shown:
            self._time = value_within(self._slider)
        elif steps:
            self.playing = False
            row = int(np.searchsorted(self._times, self._time, side="right")) - 1 + steps
            self._put(float(self._times[min(max(row, 0), self._times.size - 1)]))
        elif self.playing:
            end = self._end
            if self._time >= end:
                self._put(0.0)  # repetition, or play pressed at the end
            else:
                self._put(min(self._time + passed * _SPEEDS[self._speed.value], end))
                self.playing = self._time < end or bool(self._repeats.value)
        self._shown = self._slider.value
        self._say()
        return self._time

    def _put(self, moment: float) -> None:
        self._time = moment
        self._slider.value = round(moment, _DIGITS)  # type: ignore[misc]

    def _say(self) -> None:
        """Label the button with its function."""
        if self.playing is not self._said_playing:
            self._said_playing = self.playing
            self._button.label = "Pause" if self.playing else "Play"
            self._button.icon = viser.Icon.PLAYER_PAUSE if self.playing else viser.Icon.PLAYER_PLAY

    async def _toggle(self, _: object) -> None:
        """Toggle playback; asynchronous, as the others, so that clicks are processed in the order of arrival."""
        self.playing = not self.playing

    async def _step(self, event: viser.GuiEvent[Any]) -> None:
        self._steps.put(_STEPS.get(event.target.value, 0))

    async def _step_back(self, _: object) -> None:
        self._steps.put(-1)

    async def _step_forward(self, _: object) -> None:
        self._steps.put(1)
