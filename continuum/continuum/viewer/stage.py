"""Surroundings of the arm: camera, lights, and a grid in the plane of its base."""

from __future__ import annotations

import numpy as np
import viser

from continuum.arm import Arm
from continuum.arrays import Array

_OFFSET = np.array([1.7, 1.1, 0.53])
"""Position of the camera relative to the focal point, in lengths of the arm; the last component is upwards."""

_OFFSET_HANGING = 0.1
"""Distance of the camera below the focal point if the base is at the top, so that it is below the grid."""

_HEIGHT = 0.47
"""Height of the focal point above the base, in lengths of the arm."""

_FIELD = 0.75
"""Vertical field of view [rad]."""

_NARROW = 640
"""Width below which the panels cover the lower half of the page [pixels]; the breakpoint of viser is similar."""

_FURTHER, _LOWER = 2.4, 1.1
"""On a narrow page, factor on the distance of the camera, and shift of the focal point down, in lengths of the arm."""

_LIGHT_GRID = ((200, 200, 200), (140, 140, 140))
_DARK_GRID = ((58, 58, 58), (100, 100, 100))
"""Colours of the lines, and of every fifth line."""

_EVERY = 5


class Stage:
    """Camera, lights and grid of one page.

    Args:
        server: server of the page.
        arm: arm.

    Attributes:
        cell: spacing of the grid [m].
    """

    def __init__(self, server: viser.ViserServer, arm: Arm) -> None:
        self._server, self._length = server, arm.length
        self._hanging, self._dark = False, False
        scene, camera = server.scene, server.initial_camera
        scene.configure_environment_map(environment_intensity=0.4)
        scene.configure_default_lights(cast_shadow=False)
        camera.fov = _FIELD
        camera.near = 0.01 * arm.length
        self._set_first_view()
        self.cell = float(10.0 ** np.floor(np.log10(0.4 * arm.length)))
        self._grid = scene.add_grid(
            "/ground", width=2.4 * arm.length, height=2.4 * arm.length, cell_size=self.cell,
            section_size=_EVERY * self.cell, position=(0.0, 0.0, -0.4 * arm.sections[0].b), shadow_opacity=0.0,
        )  # fmt: skip
        server.on_client_connect(self._meet)

    @property
    def scale_in_words(self) -> str:
        """Spacing of the grid's lines."""
        return f"{1e3 * self.cell:g} mm, thick lines {1e3 * _EVERY * self.cell:g} mm"

    def set_dark(self, dark: bool) -> None:
        """Colour the grid for a dark or a light page."""
        if dark is not self._dark:
            self._dark = dark
            self._grid.cell_color, self._grid.section_color = _DARK_GRID if dark else _LIGHT_GRID

    def set_hanging(self, hanging: bool) -> None:
        """Show the base at the top or at the bottom; this resets the views of all browsers."""
        if hanging is not self._hanging:
            self._hanging = hanging
            self._set_first_view()
            for client in self._server.get_clients().values():
                self.reset(client)

    def reset(self, client: viser.ClientHandle) -> None:
        """Reset the camera of a browser to the initial view."""
        position, look_at, up = self._view(narrow=client.camera.image_width < _NARROW)
        with client.atomic():
            client.camera.up_direction = up
            client.camera.position = position
            client.camera.look_at = look_at
            client.camera.fov = _FIELD

    def _meet(self, client: viser.ClientHandle) -> None:
        if client.camera.image_width < _NARROW:
            self.reset(client)

    def _set_first_view(self) -> None:
        self._server.scene.set_up_direction("-z" if self._hanging else "+z")
        camera = self._server.initial_camera
        position, look_at, up = self._view(narrow=False)
        camera.up = tuple(up)
        camera.position = tuple(position)
        camera.look_at = tuple(look_at)

    def _view(self, narrow: bool) -> tuple[Array, Array, Array]:
        """Return the camera position, the focal point [m] and the up direction, (3,) each, in the base frame."""
        up = np.array([0.0, 0.0, -1.0 if self._hanging else 1.0])
        look_at = np.array([0.0, 0.0, _HEIGHT * self._length])
        above = -_OFFSET_HANGING if self._hanging else _OFFSET[2]
        offset = self._length * np.array([*_OFFSET[:2], above])
        if narrow:
            look_at, offset = look_at - _LOWER * self._length * up, _FURTHER * offset
        return look_at + offset, look_at, up
