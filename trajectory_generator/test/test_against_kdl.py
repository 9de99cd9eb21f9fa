"""Trajectories equal those of OROCOS KDL; ``kdl/kdl_reference.cpp`` made the figures in ``kdl/`` and says how."""

import math
from pathlib import Path as File

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from trajectory_generator.circle import circle_path
from trajectory_generator.helix import helix_points
from trajectory_generator.line import line_path
from trajectory_generator.path import Path
from trajectory_generator.rounded_path import rounded_path
from trajectory_generator.trajectory import Trajectory

POSITION_TOLERANCE = 1e-6  # m, and as much for components of a quaternion
VELOCITY_TOLERANCE = 1e-6  # m/s, rad/s


def rpy(*angles: float) -> np.ndarray:
    return Rotation.from_euler("xyz", angles).as_matrix()


def helix(corner_radius: float) -> Trajectory:
    points = helix_points(radius=0.15, pitch=0.08, z_start=0.01, z_end=0.30, n_points=301)
    path = rounded_path(points, np.tile(np.eye(3), (301, 1, 1)), corner_radius, equivalent_radius=0.002)
    return Trajectory(path, max_speed=0.1, max_acceleration=0.02, lead_time=1.0)


def turning() -> Trajectory:
    positions = [(0, 0, 0.3), (0.2, 0, 0.3), (0.25, 0.2, 0.35), (0.22, 0.33, 0.3), (0.05, 0.3, 0.2), (-0.2, 0.1, 0.25)]
    angles = [(0, 0, 0), (0.1, -0.2, 0.3), (0.1, -0.2, 0.3), (2.9, 0.4, -1.0), (-1.2, 0.9, 2.0), (-1.0, 0.8, 1.9)]
    path = rounded_path(positions, [rpy(*three) for three in angles], corner_radius=0.03, equivalent_radius=0.05)
    return Trajectory(path, max_speed=0.2, max_acceleration=0.15, lead_time=0.5)


def circle() -> Trajectory:
    start, center, toward = (0.25, 0.05, 0.2), (0.1, 0.0, 0.25), (0.1, 0.2, 0.2)
    path = circle_path(start, center, toward, 1.5 * math.pi, rpy(0.2, 0.1, 0.0), rpy(-0.5, 0.4, 1.5), 0.1)
    return Trajectory(path, max_speed=0.1, max_acceleration=0.05)


def short_line() -> Trajectory:
    path = line_path((0.1, 0, 0.3), (0.1, 0.3, 0.3), rpy(0.1, 0.2, 0.3), rpy(-0.4, 0.6, 1.0), equivalent_radius=0.1)
    return Trajectory(path, max_speed=0.1, max_acceleration=0.02)


def turn_in_place() -> Trajectory:
    place = (0.1, 0.2, 0.3)
    path = line_path(place, place, rpy(0.3, 0.0, 0.2), rpy(-0.4, 0.6, 1.0), equivalent_radius=0.2)
    return Trajectory(path, max_speed=0.1, max_acceleration=0.1)


def half_turn() -> Trajectory:
    start, axis = rpy(0.3, -0.7, 0.2), np.array([0.6, -0.75, 0.1])
    end = start @ Rotation.from_rotvec(math.pi * axis / np.linalg.norm(axis)).as_matrix()
    path: Path = line_path((0.1, 0.2, 0.3), (0.2, 0.2, 0.3), start, end, equivalent_radius=0.1)
    return Trajectory(path, max_speed=0.1, max_acceleration=0.1)


CASES = {
    "helix_corner_0.02": helix(0.02),
    "helix_corner_0.14": helix(0.14),
    "turning": turning(),
    "circle": circle(),
    "short_line": short_line(),
    "turn_in_place": turn_in_place(),
    "half_turn": half_turn(),
}


def kdl_figures(name: str) -> np.ndarray:
    """Rows of t, position, quaternion, linear and angular velocity."""
    return np.loadtxt(File(__file__).parent / "kdl" / f"{name}.csv", delimiter=",", skiprows=1)


@pytest.mark.parametrize("name", CASES)
def test_poses_and_twists_equal_those_of_kdl(name: str) -> None:
    figures = kdl_figures(name)
    sample = CASES[name].sample(figures[:, 0])

    assert sample.position == pytest.approx(figures[:, 1:4], rel=0, abs=POSITION_TOLERANCE)
    # A quaternion and its negative are one orientation.
    cosine = np.abs(np.einsum("ij,ij->i", sample.quaternion, figures[:, 4:8]))
    same_sign = figures[:, 4:8] * np.sign(np.einsum("ij,ij->i", sample.quaternion, figures[:, 4:8]))[:, None]
    assert cosine.min() > 0.5
    assert sample.quaternion == pytest.approx(same_sign, rel=0, abs=POSITION_TOLERANCE)
    assert sample.linear_velocity == pytest.approx(figures[:, 8:11], rel=0, abs=VELOCITY_TOLERANCE)
    assert sample.angular_velocity == pytest.approx(figures[:, 11:14], rel=0, abs=VELOCITY_TOLERANCE)


def test_in_metres_kdl_leaves_the_path_in_the_arcs_of_the_helix() -> None:
    """Why the helix is compared in millimetres: in metres KDL agrees on every leg and strays in every arc."""
    figures = kdl_figures("helix_corner_0.02_in_metres")
    trajectory = CASES["helix_corner_0.02"]
    moving = (figures[:, 0] > trajectory.lead_time) & (figures[:, 0] < trajectory.duration - 0.1)
    times = figures[moving, 0]
    s = trajectory.profile.position(times - trajectory.lead_time)
    in_arc = np.searchsorted(trajectory.path.ends, s) % 2 == 1
    error = np.linalg.norm(trajectory.sample(times).position - figures[moving, 1:4], axis=1)

    assert in_arc.sum() >= 10
    assert error[~in_arc].max() < POSITION_TOLERANCE
    assert error[in_arc].max() > 1e-3
