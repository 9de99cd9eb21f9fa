"""One arm in the scene: links, cables and rotation vectors of the sections, sent only when they have moved."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import viser
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from yourdfpy import URDF

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.cable_colours import Colour
from continuum.kinematics.cable_lines import section_arrow
from continuum.viewer.cable_holes import CableHoles
from continuum.viewer.link_poses import LinkPoses
from continuum.viewer.link_shapes import link_shapes
from continuum.viewer.screen_colours import linear_light, seen_on_dark
from continuum.viewer.section_angles import configuration_of_joints

_ARROW_COLOUR = (150, 0, 200)
_PALE = 0.3
"""Opacity."""

_CABLE = 0.09
"""Thickness of a cable's line relative to the hole radius of the first section; half of it where it only passes."""

_ARROW_LENGTH = 0.25
"""Length of a rotation vector for a bend of 1 rad, relative to the length of the arm."""

_STRAIGHT = 10.0
"""Radius of curvature, in lengths of the arm, beyond which a section counts as straight."""


class ArmLinks:
    """The links of an arm in the scene.

    Args:
        server: server of the page.
        name: name of the links in the scene.
        description: description of the arm.
        ghost: colour of translucent links; None for opaque links in the colours of the description.

    Attributes:
        chain: forward kinematics of the links.
        poses: poses of the links as last shown, (n_links, 4, 4) [m].
    """

    def __init__(self, server: viser.ViserServer, name: str, description: URDF, ghost: Colour | None = None) -> None:
        self.chain = LinkPoses(description)
        self._angles = np.zeros(len(self.chain.joints))
        self.poses = self.chain.poses(self._angles)
        self._frame = server.scene.add_frame(name, show_axes=False)
        self._pale = ghost is not None
        shapes = link_shapes(description, self.chain.links)
        turns, places = self._placed()
        self._meshes = [
            (
                shape.links,
                server.scene.add_batched_meshes_simple(
                    f"{name}/shape_{i}",
                    shape.vertices,
                    shape.faces,
                    batched_wxyzs=turns[shape.links],
                    batched_positions=places[shape.links],
                    batched_colors=linear_light(shape.colours) if ghost is None else linear_light(ghost),
                    opacity=None if ghost is None else _PALE,
                    flat_shading=True,
                    lod="off",
                    cast_shadow=False,
                    receive_shadow=False,
                ),
            )
            for i, shape in enumerate(shapes)
        ]

    @property
    def visible(self) -> bool:
        return self._frame.visible

    @visible.setter
    def visible(self, visible: bool) -> None:
        self._frame.visible = visible

    @property
    def pale(self) -> bool:
        """Whether they are translucent."""
        return self._pale

    @pale.setter
    def pale(self, pale: bool) -> None:
        if pale is not self._pale:
            self._pale = pale
            for _, mesh in self._meshes:
                mesh.opacity = _PALE if pale else None

    def show(self, joints: Mapping[str, float]) -> bool:
        """Move the links to the angles [rad] of the named joints; return False if they are there already."""
        angles = self.chain.angles(joints)
        if np.array_equal(angles, self._angles):
            return False
        self._angles = angles
        self.poses = self.chain.poses(angles)
        turns, places = self._placed()
        for links, mesh in self._meshes:
            mesh.batched_wxyzs = turns[links]
            mesh.batched_positions = places[links]
        return True

    def _placed(self) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Quaternions (n_links, 4), real part first, and positions (n_links, 3) [m]."""
        turns = Rotation.from_matrix(self.poses[:, :3, :3]).as_quat()[:, [3, 0, 1, 2]]
        return turns.astype(np.float32), self.poses[:, :3, 3].astype(np.float32)


class ArmScene:
    """An arm with its cables and rotation vectors.

    Args:
        server: server of the page.
        arm: arm.
        description: description of the arm.

    Attributes:
        links: links of the arm.
    """

    def __init__(self, server: viser.ViserServer, arm: Arm, description: URDF) -> None:
        self._arm = arm
        self.links = ArmLinks(server, "/arm", description)
        names = self.links.chain.links
        self._bases = [names.index(section.base_frame) for section in arm.sections]
        self._tip = names.index(arm.sections[-1].tip_frame)
        self._cables = []
        self._dark, self._vectors = False, False
        self._joints: Mapping[str, float] = {}
        for kind, thickness in (("own", _CABLE), ("passing", 0.5 * _CABLE)):
            holes = CableHoles(arm, names, passing=kind == "passing")
            if len(holes.colours):
                lines = server.scene.add_line_segments(
                    f"/cables/{kind}", holes.pieces(self.links.poses), linear_light(holes.colours),
                    thickness=thickness * arm.sections[0].a,
                )  # fmt: skip
                self._cables.append((holes, lines))
        radius = 0.004 * arm.length
        self._arrows = server.scene.add_arrows(
            "/rotation_vectors", np.zeros((arm.n_sections, 2, 3)), _ARROW_COLOUR,
            shaft_radius=radius, head_radius=2.5 * radius, head_length=6 * radius, visible=False,
        )  # fmt: skip

    def cable_lengths(self) -> dict[str, float]:
        """Return the lengths [m] of the cables as shown, by name."""
        lengths = dict.fromkeys(self._arm.cable_names, 0.0)
        for holes, lines in self._cables:
            ends = lines.points.astype(float)
            pieces = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
            for name, length in zip(holes.cables.tolist(), pieces.tolist(), strict=True):
                lengths[name] += length
        return lengths

    @property
    def tip(self) -> Array:
        """Position of the tip as shown, (3,) [m]."""
        tip: Array = self.links.poses[self._tip, :3, 3]
        return tip

    def show(self, joints: Mapping[str, float]) -> bool:
        """Move links, cables and vectors to the angles [rad] of the named joints; return False if nothing moved."""
        if not self.links.show(joints):
            return False
        for holes, lines in self._cables:
            lines.points = holes.pieces(self.links.poses).astype(np.float32)
        self._joints = joints
        self._draw_vectors()
        return True

    def set_vectors(self, shown: bool) -> None:
        """Show or hide the rotation vectors of the bent sections."""
        if shown is not self._vectors:
            self._vectors = shown
            self._draw_vectors()

    def set_dark(self, dark: bool) -> None:
        """Draw the cables in colours that are visible on a dark or a light page."""
        if dark is not self._dark:
            self._dark = dark
            for holes, lines in self._cables:
                lines.colors = linear_light(seen_on_dark(holes.colours) if dark else holes.colours)

    def _draw_vectors(self) -> None:
        arrows = self._rotation_vectors(self._joints) if self._vectors else []
        if arrows:
            self._arrows.points = np.array(arrows, dtype=np.float32)
        self._arrows.visible = bool(arrows)

    def _rotation_vectors(self, joints: Mapping[str, float]) -> list[Array]:
        w = configuration_of_joints(joints, self._arm)
        arrows = []
        for i, section in enumerate(self._arm.sections):
            arrow = section_arrow(w[i], section, _ARROW_LENGTH * self._arm.length, _STRAIGHT * self._arm.length)
            if arrow is not None:
                base = self.links.poses[self._bases[i]]
                arrows.append(arrow @ base[:3, :3].T + base[:3, 3])
        return arrows
