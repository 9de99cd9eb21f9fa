"""Playback of a recording on the page, compared with other motions of the same arm."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import viser

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.viewer.drawn_cables import drawn_cables
from continuum.viewer.layout import Layout
from continuum.viewer.motion_csv import motion_csv
from continuum.viewer.motion_legend import motion_legend
from continuum.viewer.overlay_colours import GHOST, SOLID, overlay_colour
from continuum.viewer.player import Player
from continuum.viewer.plot_data import Motion
from continuum.viewer.recorded_plots import RecordedPlots
from continuum.viewer.seen import Seen
from continuum.viewer.tracks import Track, Tracks


class Playback:
    """Source that plays from the start when the first browser connects, repeatedly unless "Repeat" is off.

    Args:
        arm: arm.
        tracks: tracks of the recording.
        name: name of the recording.
        overlays: joint angles of other motions of the same arm by name [rad], drawn as ghosts.
    """

    def __init__(self, arm: Arm, tracks: Tracks, name: str, overlays: Mapping[str, Track] | None = None) -> None:
        self._arm, self._tracks, self._name = arm, tracks, name
        self._overlays = dict(overlays or {})
        self._motions = self._all_motions()
        drawn = tracks.lengths.times.size == 0
        self._lengths = drawn_cables(self._motions[0].joints, arm) if drawn else tracks.lengths

    def add_controls(self, layout: Layout) -> None:
        """Put the controls on the page; playback starts at the first call of `newest`."""
        gui = layout.server.gui
        with layout.move:
            if len(self._motions) > 1:
                gui.add_html(motion_legend([(motion.label, motion.colour) for motion in self._motions]))
            else:
                gui.add_markdown(f"`{self._name}`")
            self.player = Player(layout, self._steps())
            save = gui.add_button("Save CSV", hint="Joint angles, tip and cables of the recording")
        save.on_click(self._save)
        self._plots = RecordedPlots(layout, self._arm, self._motions, self._lengths, self._tracks.tensions)

    def newest(self) -> Seen:
        tracks, now = self._tracks, self.player.go_on()
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

    def _steps(self) -> Array:
        """Return the times of the recording, and after its end those of the motion that ends last, (n,) [s]."""
        times = self._tracks.joints.times
        longest = max((motion.joints.times for motion in self._motions), key=lambda one: float(one[-1]))
        return np.concatenate([times, longest[longest > times[-1]]])

    def _all_motions(self) -> Sequence[Motion]:
        """Return all motions, first the one that is drawn solid."""
        tracks = self._tracks
        overlays = [Motion(name, t, overlay_colour(i)) for i, (name, t) in enumerate(self._overlays.items())]
        if not tracks.simulated.times.size:
            return [Motion(self._name, tracks.joints, SOLID), *overlays]
        return [Motion("simulated", tracks.simulated, SOLID), Motion("measured", tracks.joints, GHOST), *overlays]

    def _save(self, event: viser.GuiEvent[Any]) -> None:
        tracks = self._tracks
        if event.client is not None:
            content = motion_csv(tracks.joints, tracks.lengths, tracks.tensions, self._arm)
            event.client.send_file_download("motion.csv", content.encode(), save_immediately=True)
