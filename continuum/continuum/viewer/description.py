"""The arm's own URDF, read for its shapes."""

from __future__ import annotations

import io

import yourdfpy

from continuum.arm import Arm
from continuum.urdf.robot import urdf_text


def arm_description(arm: Arm) -> yourdfpy.URDF:
    """The description of ``arm``, without scene graphs: poses and shapes are this package's own.

    Raises:
        InvalidValueError: a section has a name that links cannot have.
    """
    return yourdfpy.URDF.load(
        io.BytesIO(urdf_text(arm).encode()), build_scene_graph=False, load_meshes=False,
        build_collision_scene_graph=False,
    )  # fmt: skip
