"""Trajectories that several tests look at, and the derivative of an orientation."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from trajectory_generator.from_parameters import trajectory_from_mapping
from trajectory_generator.trajectory import Trajectory


@pytest.fixture(scope="session")
def via_points() -> np.ndarray:
    """Six positions with unequal legs and corners."""
    return np.array([(0, 0, 0), (0.3, 0, 0), (0.3, 0.2, 0.1), (0.5, 0.4, 0.3), (0.1, 0.5, 0.1), (0.1, 0.9, 0.1)])


@pytest.fixture(scope="session")
def random_rotations() -> Callable[[int, int], np.ndarray]:
    """Orientations (count, 3, 3) by (count, seed)."""
    return lambda count, seed: Rotation.random(count, random_state=np.random.default_rng(seed)).as_matrix()


@pytest.fixture(scope="session")
def helix() -> Trajectory:
    """The thesis's helix: the default of every parameter."""
    return trajectory_from_mapping({"rest_time": 2.0})


@pytest.fixture(scope="session")
def wandering(via_points: np.ndarray) -> Trajectory:
    """A path with turning orientations, slow enough in turning that it sets the pace on some pieces."""
    quaternions = Rotation.random(len(via_points), random_state=np.random.default_rng(3)).as_quat()
    values = {
        "path": "via_points",
        "via_points.form": "xyz_quaternion",
        "via_points.list": np.hstack([via_points, quaternions]).ravel().tolist(),
        "corner_radius": 0.03,
        "equivalent_radius": 0.08,
        "max_speed": 0.3,
        "max_acceleration": 0.4,
        "lead_time": 0.5,
        "rest_time": 0.25,
    }
    return trajectory_from_mapping(values)


@pytest.fixture(params=["helix", "wandering"])
def trajectory(request: pytest.FixtureRequest) -> Trajectory:
    """Each of both in turn."""
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="session")
def angular_velocity() -> Callable[[np.ndarray, np.ndarray, float], np.ndarray]:
    """(before, after, step) -> angular velocity (n, 3) in the base frame that turns one into the other (n, 3, 3)."""

    def quotient(before: np.ndarray, after: np.ndarray, step: float) -> np.ndarray:
        return Rotation.from_matrix(after @ before.transpose(0, 2, 1)).as_rotvec() / step

    return quotient
