"""The arm's own URDF, from whichever installed package offers to write it."""

from __future__ import annotations

import io
from importlib.metadata import entry_points

import yourdfpy

from continuum.arm import Arm
from continuum.errors import ContinuumError

GROUP = "continuum.descriptions"
"""Entry point group of functions that make the text of a URDF from an `Arm`."""


class NoDescriptionError(ContinuumError):
    """No installed package writes the description of an arm."""


def arm_description(arm: Arm) -> yourdfpy.URDF:
    """The description of ``arm``, without scene graphs: poses and shapes are this package's own.

    Raises:
        NoDescriptionError: no installed package offers one.
        InvalidValueError: a section has a name that links cannot have.
    """
    offers = sorted(entry_points(group=GROUP), key=lambda offer: offer.name)
    if not offers:
        raise NoDescriptionError(f"no package that offers {GROUP} is installed; continuum_description does")
    text = offers[0].load()(arm)
    return yourdfpy.URDF.load(
        io.BytesIO(text.encode()), build_scene_graph=False, load_meshes=False, build_collision_scene_graph=False
    )
