"""Laws of every path: twists are derivatives of poses, pieces join, lengths are lengths, via points are passed."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from continuum.errors import InvalidValueError
from trajectory_generator.circle import circle_path
from trajectory_generator.helix import helix_points
from trajectory_generator.line import line_path
from trajectory_generator.path import Path
from trajectory_generator.rotation import Turn
from trajectory_generator.rounded_path import rounded_path
from trajectory_generator.trajectory import Trajectory

Quotient = Callable[[np.ndarray, np.ndarray, float], np.ndarray]
Rotations = Callable[[int, int], np.ndarray]
SAME = np.eye(3)

START = Rotation.from_euler("xyz", (0.3, -0.9, 2.0)).as_matrix()
END = Rotation.from_euler("xyz", (-1.1, 0.4, -0.5)).as_matrix()

SIMPLE = {
    "line": line_path((0, 0.1, 0.2), (0.3, -0.2, 0.5), START, END, 0.05),
    "turn_in_place": line_path((0, 0.1, 0.2), (0, 0.1, 0.2), START, END, 0.05),
    "circle": circle_path((0.3, 0, 0.1), (0.1, 0.1, 0), (0, 1, 1), 9.0, START, END, 0.05),
    "tight_circle": circle_path((0.01, 0, 0), (0, 0, 0), (0, 1, 0), 1.0, START, END, 0.5),
}


@pytest.fixture(params=[*SIMPLE, "helix", "wandering"])
def path(request: pytest.FixtureRequest) -> Path:
    return SIMPLE[request.param] if request.param in SIMPLE else request.getfixturevalue(request.param).path


def inside_of_pieces(path: Path) -> np.ndarray:
    """Some s in every piece, away from its ends."""
    return (path.ends[:, None] - path.lengths[:, None] * np.array([0.9, 0.63, 0.5, 0.1])).ravel()


def test_twist_is_the_derivative_of_the_pose(path: Path, angular_velocity: Quotient) -> None:
    s, s_dot, step = inside_of_pieces(path), 0.7, 1e-6
    (before, turned_before), (after, turned_after) = path.pose(s - step), path.pose(s + step)
    linear, angular = path.twist(s, np.full_like(s, s_dot))

    assert linear == pytest.approx(s_dot * (after - before) / (2 * step), abs=1e-8)
    assert angular == pytest.approx(s_dot * angular_velocity(turned_before, turned_after, 2 * step), abs=1e-7)


def test_neither_point_nor_frame_is_faster_than_the_path_allows_and_one_is_as_fast(path: Path) -> None:
    s = inside_of_pieces(path)
    linear, angular = path.twist(s, np.ones_like(s))
    speed = np.linalg.norm(linear, axis=1)
    turning = np.linalg.norm(angular, axis=1) * path.equivalent_radius

    assert np.maximum(speed, turning) == pytest.approx(1.0, abs=1e-9)


def test_pieces_join_in_position_orientation_and_direction(trajectory: Trajectory) -> None:
    path = trajectory.path
    assert len(path.lengths) > 8
    joints, nothing = path.ends[:-1], 1e-11
    (before, turned_before), (after, turned_after) = path.pose(joints - nothing), path.pose(joints + nothing)
    directions = [path.twist(s, np.ones_like(s))[0] for s in (joints - nothing, joints + nothing)]
    directions = [linear / np.linalg.norm(linear, axis=1, keepdims=True) for linear in directions]

    assert after == pytest.approx(before, abs=1e-10)
    assert turned_after == pytest.approx(turned_before, abs=1e-8)
    assert directions[1] == pytest.approx(directions[0], abs=1e-8)


def test_travel_is_the_integral_of_the_speed(path: Path) -> None:
    s = np.linspace(0, path.length, 400_001)
    position, _ = path.pose(s)
    chords = np.linalg.norm(np.diff(position, axis=0), axis=1).sum()

    assert path.pieces.travel.sum() == pytest.approx(chords, rel=1e-6, abs=1e-12)


@pytest.mark.parametrize("equivalent_radius", [0.002, 0.5])
def test_rounded_path_starts_and_ends_in_the_outer_via_points(
    equivalent_radius: float, via_points: np.ndarray, random_rotations: Rotations
) -> None:
    rotations = random_rotations(len(via_points), 3)
    path = rounded_path(via_points, rotations, 0.03, equivalent_radius)
    position, rotation = path.pose(np.array([-1.0, 0.0, path.length, path.length + 1.0]))

    assert position == pytest.approx(via_points[[0, 0, -1, -1]], abs=1e-12)
    assert rotation == pytest.approx(rotations[[0, 0, -1, -1]], abs=1e-9)


@pytest.mark.parametrize("corner_radius", [1e-3, 0.03, 0.05])
def test_every_via_point_is_passed_at_the_distance_of_its_corner(corner_radius: float, via_points: np.ndarray) -> None:
    path = rounded_path(via_points, np.tile(SAME, (len(via_points), 1, 1)), corner_radius, 0.002)
    position, _ = path.pose(np.linspace(0, path.length, 20_001))
    in_arcs, _ = path.pose((path.ends - path.lengths / 2)[1::2])
    legs = np.diff(via_points, axis=0)
    legs /= np.linalg.norm(legs, axis=1, keepdims=True)
    for i in range(1, len(via_points) - 1):
        corner = math.acos(legs[i - 1] @ legs[i])
        expected = corner_radius * (1 / math.cos(corner / 2) - 1)
        assert np.linalg.norm(in_arcs[i - 1] - via_points[i]) == pytest.approx(expected, abs=1e-12)
        assert np.linalg.norm(position - via_points[i], axis=1).min() > expected - 1e-12


def test_via_points_in_line_are_passed_through() -> None:
    points = np.array([(0, 0, 0), (0.1, 0, 0), (0.3, 0, 0), (0.3, 0.2, 0)])
    path = rounded_path(points, np.tile(SAME, (4, 1, 1)), 0.05, 0.002)
    assert len(path.lengths) == 4
    assert path.length == pytest.approx(0.25 + 0.15 + 0.05 * math.pi / 2)
    assert path.pose(np.array([0.1]))[0] == pytest.approx(points[[1]])


def test_a_leg_that_just_fits_is_taken_and_one_that_just_does_not_is_refused() -> None:
    square = np.array([(0, 0, 0), (0.1, 0, 0), (0.1, 0.1, 0), (0, 0.1, 0)])  # quarter turns take one radius each
    same = np.tile(SAME, (4, 1, 1))
    length = rounded_path(square, same, 0.05 - 1e-9, 0.002).length
    assert length == pytest.approx(0.05 * (2 + math.pi), abs=1e-7)
    with pytest.raises(InvalidValueError, match=r"corner_radius is .*less than 0.05 m.*\[1\] to via_points\[2\]"):
        rounded_path(square, same, 0.05 + 1e-9, 0.002)


def test_helix_points_lie_on_the_helix_up_and_down() -> None:
    up, down = helix_points(0.15, 0.08, 0.01, 0.3, 301), helix_points(0.15, 0.08, 0.3, 0.01, 301)
    for points in (up, down):
        assert np.hypot(points[:, 0], points[:, 1]) == pytest.approx(0.15)
        turn = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
        assert np.diff(turn) / np.diff(points[:, 2]) == pytest.approx(2 * math.pi / 0.08)
    assert up[0] == pytest.approx((0.15, 0, 0.01))
    assert (up[-1, 2], down[0, 2], down[-1, 2]) == pytest.approx((0.3, 0.3, 0.01))


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-3, 2.0, math.pi - 1e-3, math.pi - 5e-7, math.pi])
def test_turn_ends_where_it_should_about_one_axis(angle: float, random_rotations: Rotations) -> None:
    start = random_rotations(20, 5)
    axis = np.random.default_rng(6).normal(size=(20, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    end = start @ Rotation.from_rotvec(angle * axis).as_matrix()
    turn = Turn.between(start, end)

    assert turn.orientation(np.zeros(20)) == pytest.approx(start, abs=1e-14)
    assert turn.orientation(np.ones(20)) == pytest.approx(end, abs=1e-12)
    assert turn.angle == pytest.approx(angle, abs=1.01e-6)
    assert np.linalg.norm(turn.axis, axis=1) == pytest.approx(1.0)
    assert turn.orientation(np.full(20, 0.3)) @ turn.axis[:, :, None] == pytest.approx(start @ turn.axis[:, :, None])
