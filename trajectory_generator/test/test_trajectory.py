"""Laws of a trajectory: rest, motion, rest; twists are derivatives of poses; limits hold."""

from collections.abc import Callable

import numpy as np
import pytest

from continuum.errors import InvalidValueError
from trajectory_generator.trajectory import Trajectory

Quotient = Callable[[np.ndarray, np.ndarray, float], np.ndarray]


def test_it_rests_before_and_after_in_the_ends_of_its_path(trajectory: Trajectory) -> None:
    t = np.array([-1.0, 0.0, trajectory.lead_time, trajectory.duration - trajectory.rest_time, trajectory.duration + 9])
    sample = trajectory.sample(t)
    ends = np.array([0.0, 0.0, 0.0, 1.0, 1.0]) * trajectory.path.length

    assert sample.position == pytest.approx(trajectory.path.pose(ends)[0], abs=1e-12)
    assert sample.linear_velocity == pytest.approx(0.0, abs=1e-12)
    assert sample.angular_velocity == pytest.approx(0.0, abs=1e-12)


def test_speed_limit_holds_and_is_used(trajectory: Trajectory) -> None:
    sample = trajectory.sample(trajectory.times(500.0))
    speed = np.linalg.norm(sample.linear_velocity, axis=1)
    turning = np.linalg.norm(sample.angular_velocity, axis=1) * trajectory.path.equivalent_radius
    assert np.maximum(speed, turning).max() == pytest.approx(trajectory.max_speed, rel=1e-9)


def test_quaternions_are_of_length_one_with_w_not_negative(wandering: Trajectory) -> None:
    quaternion = wandering.sample(wandering.times(100.0)).quaternion
    assert np.linalg.norm(quaternion, axis=1) == pytest.approx(1.0)
    assert quaternion[:, 3].min() >= 0


def test_instants_reach_the_end_at_the_rate(trajectory: Trajectory) -> None:
    t = trajectory.times(120.0)
    assert t[0] == 0
    assert np.diff(t) == pytest.approx(1 / 120)
    assert trajectory.duration <= t[-1] < trajectory.duration + 1 / 120


@pytest.mark.parametrize("shape", [(), (1,), (2, 3), (0,)])
def test_one_call_takes_instants_of_any_shape(shape: tuple[int, ...], wandering: Trajectory) -> None:
    t = np.linspace(0, wandering.duration, int(np.prod(shape))).reshape(shape)
    sample = wandering.sample(t)
    assert sample.position.shape == sample.linear_velocity.shape == sample.angular_velocity.shape == (*shape, 3)
    assert sample.quaternion.shape == (*shape, 4)
    flat = [wandering.sample(one).position for one in t.ravel()]
    assert sample.position.reshape(-1, 3).tolist() == [one.tolist() for one in flat]


@pytest.mark.parametrize("values", [{"max_speed": 0.0}, {"max_acceleration": float("nan")}, {"lead_time": -1.0}])
def test_bad_limits_are_refused_by_name(values: dict[str, float], helix: Trajectory) -> None:
    with pytest.raises(InvalidValueError, match=next(iter(values))):
        Trajectory(**{"path": helix.path, "max_speed": 0.1, "max_acceleration": 0.1, **values})
