"""The URDF of an arm, read for its shapes."""

from __future__ import annotations

import io

import yourdfpy

from continuum.arm import Arm
from continuum.urdf.robot import urdf_text


def arm_description(arm: Arm) -> yourdfpy.URDF:
    """Return the description of ``arm``, without scene graphs: this package computes poses and shapes itself.

    Raises:
        InvalidValueError: the name of a section is not a valid link name.
    """
    return yourdfpy.URDF.load(
        io.BytesIO(urdf_text(arm).encode()), build_scene_graph=False, load_meshes=False,
        build_collision_scene_graph=False,
    )  # fmt: skip
