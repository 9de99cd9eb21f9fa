"""The page: a scene of the arm with its controls and plots, served on an address, with one source of states."""

from __future__ import annotations

import io
import sys
import threading
import time
from collections.abc import Mapping
from contextlib import redirect_stdout
from dataclasses import replace

import viser

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.burst_log import BurstLog
from continuum.cable_colours import Colour
from continuum.viewer.address import HOST, PORT, check_address, url
from continuum.viewer.arm_scene import ArmLinks, ArmScene
from continuum.viewer.description import arm_description
from continuum.viewer.layout import NAME, layout_of
from continuum.viewer.origin_guard import kept_guard
from continuum.viewer.overlay_colours import GHOST, SOLID, overlay_colour
from continuum.viewer.plots import LivePlots
from continuum.viewer.readout import Readout
from continuum.viewer.seen import Seen, Source
from continuum.viewer.stage import Stage
from continuum.viewer.status_table import StatusTable
from continuum.viewer.trail import Trail
from continuum.viewer.view_controls import ViewControls

FRAME_RATE = 30.0
"""Largest number of frames per second."""

_TARGET_COLOUR = (0.55, 0.55, 0.60)


class Page:
    """An arm in the browser. Each frame shows the newest state of the source; states between frames are not drawn.

    Args:
        arm: arm.
        source: source of the state to draw.
        host: address that the page is served on; the default is reachable from this host only.
        port: port; 0 for any free port.
        faults: log of refused messages from browsers; on stderr by default.
        title: title of the page in the browser.
        hanging: whether the base is initially shown at the top.

    Attributes:
        frames: number of frames drawn so far.

    Raises:
        InvalidValueError: the page cannot be served on that address.
    """

    def __init__(
        self, arm: Arm, source: Source, host: str = HOST, port: int = PORT, faults: BurstLog | None = None,
        title: str = NAME, hanging: bool = False,
    ) -> None:  # fmt: skip
        check_address(host, port)
        self.frames = 0
        self._source = source
        self._arm = arm
        self._description = arm_description(arm)
        self._faults = faults or BurstLog(lambda line: print(line, file=sys.stderr), time.monotonic, "dropped, ")
        words: set[str] = set()
        with redirect_stdout(io.StringIO()), kept_guard(host, words, self._faults, title):  # viser prints a banner
            self._server = viser.ViserServer(host=host, port=port, label=NAME, verbose=False)
        self._host = host
        layout = layout_of(self._server, self._faults, words)
        stage = Stage(self._server, arm)
        source.add_controls(layout)
        self._scene = ArmScene(self._server, arm, self._description)
        self._ghosts: dict[str, ArmLinks] = {}
        self._plots: LivePlots | None = None
        self._layout = layout
        self._readout = Readout(layout, stage.scale_in_words)
        self._view = ViewControls(layout, stage, hanging)
        self._statuses = StatusTable(layout)
        step, thickness = 0.002 * arm.length, 0.003 * arm.length
        self._tip_trail = Trail(self._server, "/trail_of_tip", SOLID, step, thickness)
        self._target_trail = Trail(self._server, "/trail_of_target", _TARGET_COLOUR, step, thickness)
        self._target = self._server.scene.add_icosphere(
            "/wanted", 0.015 * arm.length, (90, 90, 100), cast_shadow=False, visible=False
        )

    @property
    def address(self) -> str:
        """URL to open in a browser."""
        return url(self._host, self._server.get_port())

    @property
    def browsers(self) -> int:
        """Number of connected browsers."""
        return len(self._server.get_clients())

    def run(self, stop: threading.Event) -> None:
        """Draw until ``stop`` is set; the source is queried and frames are drawn only while a browser is connected."""
        due = time.monotonic()
        while not stop.wait(max(0.0, due - time.monotonic())):
            due = max(due + 1.0 / FRAME_RATE, time.monotonic())
            self._faults.tick()
            if self.browsers:
                self.draw()

    def draw(self) -> None:
        """One frame."""
        self.frames += 1
        seen = self._source.newest()
        with self._server.atomic():
            self._view.apply()
            self._scene.set_dark(self._view.dark)
            self._scene.set_vectors(self._view.vectors)
            self._draw_arms(seen)
            self._draw_target(seen.target)
            self._draw_plots(seen)
            self._statuses.show(seen.statuses)

    def close(self) -> None:
        """Stop the server."""
        with redirect_stdout(io.StringIO()):
            self._server.stop()

    def _draw_arms(self, seen: Seen) -> None:
        self._scene.links.pale = not seen.has_posture
        if self._scene.show(seen.simulated or seen.joints):
            self._tip_trail.follow(self._scene.tip)
        self._readout.show(self._scene.tip if seen.has_posture else None)
        self._draw_ghost("/ghost", GHOST, seen.joints if seen.simulated else {})
        for i, joints in enumerate(seen.overlays):
            self._draw_ghost(f"/overlay_{i + 1}", overlay_colour(i), joints)

    def _draw_ghost(self, name: str, colour: Colour, joints: Mapping[str, float]) -> None:
        """Draw a translucent arm, which is created when it is first needed."""
        if joints and name not in self._ghosts:
            self._ghosts[name] = ArmLinks(self._server, name, self._description, colour)
        if name in self._ghosts:
            self._ghosts[name].visible = bool(joints)
        if joints:
            self._ghosts[name].show(joints)

    def _draw_plots(self, seen: Seen) -> None:
        if seen.plots is not None:
            seen.plots.show(seen.time, self._view.dark)
            return
        if self._plots is None:
            self._plots = LivePlots(self._layout, self._arm)
        drawn = seen.has_posture and not seen.lengths
        shown = replace(seen, lengths=self._scene.cable_lengths()) if drawn else seen
        self._plots.show(shown, self._view.dark)

    def _draw_target(self, target: Array | None) -> None:
        self._target.visible = target is not None
        if target is not None:
            self._target.position = target
            self._target_trail.follow(target)
