"""The page: a scene of the arm and what stands beside it, served on an address and fed by one source."""

from __future__ import annotations

import io
import sys
import threading
import time
from contextlib import redirect_stdout
from dataclasses import replace

import numpy as np
import viser

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.burst_log import BurstLog
from continuum.viewer.address import HOST, PORT, check_address, url
from continuum.viewer.arm_scene import ArmLinks, ArmScene
from continuum.viewer.description import arm_description
from continuum.viewer.layout import layout_of
from continuum.viewer.origin_guard import kept_guard
from continuum.viewer.plots import CablePlots
from continuum.viewer.seen import Seen, Source
from continuum.viewer.status_table import StatusTable
from continuum.viewer.trail import Trail

FRAME_RATE = 30.0
"""Most frames a second."""

_TARGET_COLOUR = (0.55, 0.55, 0.60)
_TIP_COLOUR = (0.95, 0.45, 0.10)


class Page:
    """An arm in the browser. Drawing asks the source for the newest state; what came between is never drawn.

    Args:
        arm: the arm.
        source: says what is to be seen.
        host: address that the page is served on; the default is reached from this host alone.
        port: 0 for any that is free.
        faults: where it is noted what browsers must not say; on stderr by default.

    Attributes:
        frames: drawn so far.

    Raises:
        InvalidValueError: nobody can listen on that address.
    """

    def __init__(
        self, arm: Arm, source: Source, host: str = HOST, port: int = PORT, faults: BurstLog | None = None
    ) -> None:
        check_address(host, port)
        self.frames = 0
        self._source = source
        self._arm = arm
        self._description = arm_description(arm)
        self._faults = faults or BurstLog(lambda line: print(line, file=sys.stderr), time.monotonic, "dropped, ")
        words: set[str] = set()
        with redirect_stdout(io.StringIO()), kept_guard(host, words, self._faults):  # it has a banner of its own
            self._server = viser.ViserServer(host=host, port=port, label="continuum", verbose=False)
        self._host = host
        layout = layout_of(self._server, self._faults, words)
        self._set_up_view()
        source.add_controls(layout)
        self._scene = ArmScene(self._server, arm, self._description)
        self._ghost: ArmLinks | None = None
        self._plots = CablePlots(layout, arm)
        self._statuses = StatusTable(layout)
        step, thickness = 0.002 * arm.length, 0.003 * arm.length
        self._tip_trail = Trail(self._server, "/trail_of_tip", _TIP_COLOUR, step, thickness)
        self._target_trail = Trail(self._server, "/trail_of_target", _TARGET_COLOUR, step, thickness)
        self._target = self._server.scene.add_icosphere(
            "/wanted", 0.015 * arm.length, (90, 90, 100), cast_shadow=False, visible=False
        )

    @property
    def address(self) -> str:
        """What to open in a browser."""
        return url(self._host, self._server.get_port())

    @property
    def lookers(self) -> int:
        """Browsers that are connected."""
        return len(self._server.get_clients())

    def run(self, stop: threading.Event) -> None:
        """Draw until ``stop``; nothing is asked or drawn while nobody looks."""
        due = time.monotonic()
        while not stop.wait(max(0.0, due - time.monotonic())):
            due = max(due + 1.0 / FRAME_RATE, time.monotonic())
            self._faults.tick()
            if self.lookers:
                self.draw()

    def draw(self) -> None:
        """One frame."""
        self.frames += 1
        seen = self._source.newest()
        with self._server.atomic():
            self._draw_arms(seen)
            self._draw_target(seen.target)
            drawn = seen.has_posture and not seen.lengths
            self._plots.show(replace(seen, lengths=self._scene.cable_lengths()) if drawn else seen)
            self._statuses.show(seen.statuses)

    def close(self) -> None:
        """End the server."""
        with redirect_stdout(io.StringIO()):
            self._server.stop()

    def _draw_arms(self, seen: Seen) -> None:
        self._scene.links.pale = not seen.has_posture
        if self._scene.show(seen.simulated or seen.joints):
            self._tip_trail.follow(self._scene.tip)
        if seen.simulated and seen.joints:
            if self._ghost is None:
                self._ghost = ArmLinks(self._server, "/ghost", self._description, ghost=True)
            self._ghost.show(seen.joints)
        if self._ghost is not None:
            self._ghost.visible = bool(seen.simulated and seen.joints)

    def _draw_target(self, target: Array | None) -> None:
        self._target.visible = target is not None
        if target is not None:
            self._target.position = target
            self._target_trail.follow(target)

    def _set_up_view(self) -> None:
        length = self._arm.length
        scene, camera = self._server.scene, self._server.initial_camera
        scene.set_up_direction("+z")
        camera.up = (0.0, 0.0, 1.0)
        camera.position = (1.7 * length, 1.1 * length, 1.0 * length)
        camera.fov = 0.75
        camera.look_at = (0.0, 0.0, 0.47 * length)
        scene.configure_environment_map(environment_intensity=0.4)
        scene.configure_default_lights(cast_shadow=False)
        camera.near = 0.01 * length
        plane = -0.4 * self._arm.sections[0].b
        cell = float(10.0 ** np.floor(np.log10(0.4 * length)))
        scene.add_grid(
            "/ground", width=2.4 * length, height=2.4 * length, cell_size=cell, section_size=5 * cell,
            position=(0.0, 0.0, plane), shadow_opacity=0.0,
        )  # fmt: skip
