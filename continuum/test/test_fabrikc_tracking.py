"""Following a moving tip by FABRIKc: it stays on the path, and its rates are those of its configurations."""

import numpy as np
import pytest
from test_tracking import ARM, DT, circle, follow

from continuum.errors import InvalidValueError
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.fabrikc_tracking import FabrikcTracker
from continuum.kinematics.ik_result import IkStatus


def test_it_follows_a_circle_with_rates_that_are_the_differences_of_its_configurations() -> None:
    answers = follow(FabrikcTracker(ARM, tolerance=1e-9), 360)
    for k, answer in enumerate(answers):
        assert answer.result.status is IkStatus.SOLVED
        tip = arm_pose(answer.result.configuration, ARM)[:3, 3]
        np.testing.assert_allclose(tip, circle(k * DT)[0], rtol=0, atol=1e-9)
    configurations, rates = (
        np.array(one) for one in zip(*((a.result.configuration, a.rate) for a in answers), strict=True)
    )
    differences = (configurations[2:] - configurations[:-2]) / (2 * DT)
    assert np.max(np.abs(differences - rates[1:-1])) <= 0.01 * np.max(np.abs(rates))


def test_a_first_pose_is_answered_as_the_algorithm_by_itself_answers_it() -> None:
    position, direction = np.array([0.15, 0.0, 0.3]), np.array([1.0, 0.0, 1.0])
    by_itself = solve_fabrikc(ARM, position, direction, tolerance=1e-8, max_iterations=50)
    tracked = FabrikcTracker(ARM, use_direction=True, tolerance=1e-8, max_iterations=50).pose(position, direction)
    assert tracked.result.iterations == by_itself.iterations > 1
    np.testing.assert_array_equal(tracked.result.configuration, by_itself.configuration)
    assert tracked.rate is None


def test_out_of_reach_it_says_how_far_it_stayed_and_it_comes_back() -> None:
    tracker = FabrikcTracker(ARM, tolerance=1e-6)
    follow(tracker, 10)
    far, velocity = np.array([0.0, 0.0, 2 * ARM.length]), np.array([0.0, 0.0, 0.1])
    missed = tracker.pose(far, velocity=velocity, dt=DT)
    assert missed.result.status is IkStatus.NO_CONVERGENCE
    tip = arm_pose(missed.result.configuration, ARM)[:3, 3]
    np.testing.assert_allclose(missed.result.distance, np.linalg.norm(far - tip), rtol=1e-9)
    assert missed.rate is not None
    assert np.all(np.isfinite(missed.rate))
    assert tracker.pose(circle(0.0)[0], dt=DT).result.solved


@pytest.mark.parametrize("count", [-1, 2.5])
def test_a_number_of_iterations_that_cannot_be_is_refused(count: float) -> None:
    with pytest.raises(InvalidValueError):
        FabrikcTracker(ARM, max_iterations=count)  # type: ignore[arg-type]
