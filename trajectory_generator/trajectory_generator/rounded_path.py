"""A path past via points: straight legs whose corners are rounded by arcs (KDL: Path_RoundedComposite).

At a corner of angle alpha, an arc of radius r touches both legs at r tan(alpha / 2) from the via point and passes it at
the distance r (1 / cos(alpha / 2) - 1). The orientation follows the legs; along an arc it rotates about one axis
between the orientations of the legs at the ends of the arc.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from trajectory_generator.checked_arrays import finite_array, positive, rotation_matrices
from trajectory_generator.circle import arc_pieces
from trajectory_generator.line import SHORTEST_TRAVEL, line_path, line_pieces
from trajectory_generator.path import Path, Pieces
from trajectory_generator.rotation import Turn

STRAIGHT = 1e-7
"""Smaller corners are not rounded; corners that differ from half a turn by less fold back and are refused [rad]."""


@dataclass(frozen=True, eq=False)
class Legs:
    """The n - 1 straight legs between n via points, and the n - 2 corners between the legs.

    Attributes:
        direction: unit vector of every leg (n - 1, 3).
        distance: length of every leg (n - 1,) [m].
    """

    direction: Array
    distance: Array

    @property
    def corner_angle(self) -> Array:
        """Change of direction at every inner via point (n - 2,) [rad], 0 to pi."""
        before, after = self.direction[:-1], self.direction[1:]
        sine = np.linalg.norm(np.cross(before, after), axis=1)
        cosine = np.einsum("ij,ij->i", before, after)
        angle: Array = np.arctan2(sine, cosine)
        return angle


def rounded_path(positions: ArrayLike, rotations: ArrayLike, corner_radius: float, equivalent_radius: float) -> Path:
    """Return the path from the first via point to the last, past the inner ones.

    Args:
        positions: via points (n, 3) [m], n >= 2.
        rotations: orientations there (n, 3, 3).
        corner_radius: radius of the arcs [m].
        equivalent_radius: see :class:`Path` [m/rad].

    Raises:
        InvalidValueError: there are fewer than two via points, two neighbours coincide, the path folds back by half a
            turn, or a leg is too short for the arcs at its ends; the message counts via points from 0.
    """
    points = finite_array("via_points", positions, (-1, 3))
    frames = rotation_matrices("via_points.rotation", rotations)
    positive("corner_radius", corner_radius, "m")
    if len(points) < 2 or len(frames) != len(points):
        raise InvalidValueError(
            "via_points", f"{len(points)} positions, {len(frames)} rotations", "two or more of each"
        )
    if len(points) == 2:
        return line_path(points[0], points[1], frames[0], frames[1], equivalent_radius)

    legs = _legs(points)
    angle = legs.corner_angle
    _refuse_folds(points, angle)
    rounded = angle >= STRAIGHT
    # Length of leg that the arc occupies on either side of every via point; the ends have no arc.
    cut = np.zeros(len(points))
    cut[1:-1] = np.where(rounded, corner_radius * np.tan(angle / 2), 0.0)
    _refuse_tight_corners(legs, cut, corner_radius)

    leg_turn = Turn.between(frames[:-1], frames[1:])
    on_line = leg_turn.part(cut[:-1] / legs.distance, 1 - cut[1:] / legs.distance)
    lines = line_pieces(
        points[:-1] + cut[:-1, None] * legs.direction,
        legs.direction,
        legs.distance - cut[:-1] - cut[1:],
        on_line,
    )
    corner = np.flatnonzero(rounded)
    before, after = legs.direction[corner], legs.direction[corner + 1]
    inwards = after - before * np.einsum("ij,ij->i", before, after)[:, None]
    arcs = arc_pieces(
        points[corner + 1] - cut[corner + 1, None] * before,
        before,
        inwards / np.linalg.norm(inwards, axis=1, keepdims=True),
        np.full(len(corner), corner_radius),
        angle[corner],
        Turn.between(on_line.orientation(np.ones_like(legs.distance))[corner], on_line.start[corner + 1]),
    )
    # The arc of corner k, at via point k + 1, lies between the lines k and k + 1.
    order = np.argsort(np.concatenate([2 * np.arange(len(legs.distance)), 2 * corner + 1]))
    return Path(Pieces.joined([lines, arcs]).take(order), equivalent_radius)


def _legs(points: Array) -> Legs:
    chord = np.diff(points, axis=0)
    distance = np.linalg.norm(chord, axis=1)
    for i in np.flatnonzero(distance < SHORTEST_TRAVEL):
        raise InvalidValueError(
            f"via_points[{i + 1}]",
            points[i + 1].tolist(),
            f"a point at least {SHORTEST_TRAVEL:g} m from via_points[{i}]; a rotation in place needs a separate path",
        )
    return Legs(chord / distance[:, None], distance)


def _refuse_folds(points: Array, angle: Array) -> None:
    for i in np.flatnonzero(np.pi - angle < STRAIGHT):
        raise InvalidValueError(
            f"via_points[{i + 1}]", points[i + 1].tolist(), "a point where the path does not fold back on itself"
        )


def _refuse_tight_corners(legs: Legs, cut: Array, corner_radius: float) -> None:
    needed = cut[:-1] + cut[1:]
    if np.all(needed < legs.distance):
        return
    i = int(np.argmax(needed / legs.distance))
    raise InvalidValueError(
        "corner_radius",
        corner_radius,
        f"less than {corner_radius * legs.distance[i] / needed[i]:.6g} m: "
        f"the distance from via_points[{i}] to via_points[{i + 1}] is {legs.distance[i]:.6g} m, "
        f"and rounding its corners takes {needed[i]:.6g} m",
    )
