"""Straight lines (KDL: Path_Line)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from trajectory_generator.checked_arrays import finite_array
from trajectory_generator.path import Path, Pieces
from trajectory_generator.rotation import Turn

SHORTEST_TRAVEL = 1e-7
"""Points closer than this count as one [m], as in KDL."""

SMALLEST_TURN = 1e-6
"""Smallest rotation in place that counts as a path [rad]."""


def line_pieces(start: Array, tangent: Array, travel: Array, turn: Turn) -> Pieces:
    """Return lines from ``start`` (m, 3) [m] by ``travel`` (m,) [m] along ``tangent`` (m, 3)."""
    return Pieces(start, tangent, np.zeros_like(start), np.zeros_like(travel), travel, turn)


def line_path(
    start: ArrayLike,
    end: ArrayLike,
    start_rotation: ArrayLike,
    end_rotation: ArrayLike,
    equivalent_radius: float,
) -> Path:
    """Return one straight line, or a rotation in place if both points are equal.

    Args:
        start, end: positions (3,) [m].
        start_rotation, end_rotation: orientations (3, 3).
        equivalent_radius: see :class:`Path` [m/rad].

    Raises:
        InvalidValueError: a value is invalid, or both poses are equal.
    """
    first, last = finite_array("start", start, (3,)), finite_array("end", end, (3,))
    turn = Turn.between_two(start_rotation, end_rotation)
    chord = (last - first)[None]
    travel = np.linalg.norm(chord, axis=1)
    if travel[0] < SHORTEST_TRAVEL and turn.angle[0] < SMALLEST_TURN:
        raise InvalidValueError(
            "end",
            last.tolist(),
            f"a pose at least {SHORTEST_TRAVEL:g} m or {SMALLEST_TURN:g} rad from the start",
        )
    tangent = np.divide(chord, travel[:, None], out=np.zeros_like(chord), where=travel[:, None] > 0)
    return Path(line_pieces(first[None], tangent, travel, turn), equivalent_radius)
