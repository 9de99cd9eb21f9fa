"""A path through space: a sequence of lines and arcs, each with a rotation about one axis (KDL: Path_Composite)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from continuum.arrays import Array
from trajectory_generator.checked_arrays import positive
from trajectory_generator.rotation import Turn


@dataclass(frozen=True, eq=False)
class Pieces:
    """Curves of constant curvature, one per row: arcs, or lines where the curvature is zero.

    Attributes:
        start: first point (m, 3) [m].
        tangent: unit vector of the motion at the start (m, 3).
        normal: unit vector from the start to the centre (m, 3); meaningless for a line.
        curvature: inverse of the radius (m,) [1/m].
        travel: distance from first to last point along the curve (m,) [m].
        turn: m rotations along the curves.
    """

    start: Array
    tangent: Array
    normal: Array
    curvature: Array
    travel: Array
    turn: Turn

    def take(self, rows: np.ndarray | slice) -> Pieces:
        """Return the pieces of ``rows``, in that order and shape."""
        return Pieces(
            self.start[rows],
            self.tangent[rows],
            self.normal[rows],
            self.curvature[rows],
            self.travel[rows],
            self.turn.take(rows),
        )

    @classmethod
    def joined(cls, parts: Sequence[Pieces]) -> Pieces:
        """Concatenate the pieces of ``parts``."""
        return cls(
            np.concatenate([part.start for part in parts]),
            np.concatenate([part.tangent for part in parts]),
            np.concatenate([part.normal for part in parts]),
            np.concatenate([part.curvature for part in parts]),
            np.concatenate([part.travel for part in parts]),
            Turn.joined([part.turn for part in parts]),
        )


@dataclass(frozen=True, eq=False)
class Path:
    """A sequence of pieces with one path parameter s.

    The length of a piece is the larger of its distance and its angle times the equivalent radius, so with
    ``|s_dot| <= v`` no point moves faster than v and no frame rotates faster than v / equivalent_radius. Where a piece
    limited by distance meets one limited by angle, the speeds jump, as in KDL.

    Attributes:
        pieces: the pieces, each with a travel, a rotation, or both.
        equivalent_radius: smallest path length for one radian of rotation [m/rad].

    Raises:
        InvalidValueError: the equivalent radius is not a positive number.
    """

    pieces: Pieces
    equivalent_radius: float

    def __post_init__(self) -> None:
        positive("equivalent_radius", self.equivalent_radius, "m")

    @cached_property
    def lengths(self) -> Array:
        """Length of every piece (m,) [m]."""
        return self._lengths_of(self.pieces)

    @cached_property
    def ends(self) -> Array:
        """s at the end of every piece (m,) [m]."""
        return np.cumsum(self.lengths)

    @property
    def length(self) -> float:
        """s at the end of the path [m]; its start is at s = 0."""
        return float(self.ends[-1])

    def pose(self, s: Array) -> tuple[Array, Array]:
        """Return position (..., 3) [m] and orientation (..., 3, 3) at ``s`` (...) [m]; s is clipped to the path."""
        piece, fraction = self._locate(s)
        travelled = fraction * piece.travel
        half_angle = piece.curvature * travelled / 2
        # An arc of radius r in the frame of its start: r sin(phi) forwards, r (1 - cos(phi)) sideways,
        # phi = travelled / r.
        forwards = travelled * np.sinc(2 * half_angle / np.pi)
        sideways = travelled * np.sinc(half_angle / np.pi) * np.sin(half_angle)
        position = piece.start + forwards[..., None] * piece.tangent + sideways[..., None] * piece.normal
        return position, piece.turn.orientation(fraction)

    def twist(self, s: Array, s_dot: Array) -> tuple[Array, Array]:
        """Return linear (..., 3) [m/s] and angular velocity (..., 3) [rad/s], both in the base frame.

        Args:
            s: path parameter (...) [m].
            s_dot: its rate (...) [m/s].
        """
        piece, fraction = self._locate(s)
        fraction_rate = s_dot / self._lengths_of(piece)
        angle = (piece.curvature * fraction * piece.travel)[..., None]
        direction = np.cos(angle) * piece.tangent + np.sin(angle) * piece.normal
        return direction * (fraction_rate * piece.travel)[..., None], piece.turn.rate(fraction_rate)

    def _lengths_of(self, pieces: Pieces) -> Array:
        """Return the lengths of ``pieces`` (...) [m]."""
        return np.maximum(pieces.travel, self.equivalent_radius * pieces.turn.angle)

    def _locate(self, s: Array) -> tuple[Pieces, Array]:
        """Return the piece of every s (...), and the fraction (...) of it; a joint belongs to the earlier piece."""
        index = np.minimum(np.searchsorted(self.ends, s), len(self.ends) - 1)
        fraction = 1 - (self.ends[index] - s) / self.lengths[index]
        return self.pieces.take(index), np.clip(fraction, 0.0, 1.0)
