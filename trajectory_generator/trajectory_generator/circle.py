"""Arcs of circles (KDL: Path_Circle)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from trajectory_generator.checked_arrays import finite_array, positive
from trajectory_generator.path import Path, Pieces
from trajectory_generator.rotation import Turn

SMALLEST_RADIUS = 1e-6
"""Smallest distance of a circle's start from its centre [m]."""


def arc_pieces(start: Array, tangent: Array, normal: Array, radius: Array, angle: Array, turn: Turn) -> Pieces:
    """Return arcs from ``start`` (m, 3) [m] along ``tangent``, with the centre at ``radius`` (m,) [m] on ``normal``."""
    return Pieces(start, tangent, normal, 1 / radius, radius * angle, turn)


def circle_path(
    start: ArrayLike,
    center: ArrayLike,
    toward: ArrayLike,
    angle: float,
    start_rotation: ArrayLike,
    end_rotation: ArrayLike,
    equivalent_radius: float,
) -> Path:
    """Return one arc about ``center``, from ``start`` to the side of ``toward``, of one or several revolutions.

    Args:
        start, center: positions (3,) [m].
        toward: position (3,) [m] in the plane of the circle, off the line through start and centre.
        angle: angle of the arc [rad], positive; more than 2 pi for more than one revolution.
        start_rotation, end_rotation: orientations (3, 3).
        equivalent_radius: see :class:`Path` [m/rad].

    Raises:
        InvalidValueError: a value is invalid, or the three points do not define a circle.
    """
    first, middle, side = (
        finite_array(name, point, (3,)) for name, point in (("start", start), ("center", center), ("toward", toward))
    )
    positive("angle", angle, "rad")
    outwards = first - middle
    radius = float(np.linalg.norm(outwards))
    if radius < SMALLEST_RADIUS:
        raise InvalidValueError("start", first.tolist(), f"a point at least {SMALLEST_RADIUS:g} m from the center")
    outwards /= radius
    sideways = side - middle
    tangent = sideways - outwards * (outwards @ sideways)
    if np.linalg.norm(tangent) < SMALLEST_RADIUS:
        raise InvalidValueError("toward", side.tolist(), "a point off the line through start and center")
    tangent /= np.linalg.norm(tangent)
    turn = Turn.between_two(start_rotation, end_rotation)
    arc = arc_pieces(first[None], tangent[None], -outwards[None], np.array([radius]), np.array([angle]), turn)
    return Path(arc, equivalent_radius)
