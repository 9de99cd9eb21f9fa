"""The Gauss-Newton step and the task that it works on."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_slopes, differences
from continuum_laws.samples import arm_of, mixed_arm, random_postures

from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import bend
from continuum.kinematics.gauss_newton import damped_solve, refine
from continuum.kinematics.ik_result import IkStatus, Target
from continuum.kinematics.tip_task import TipTask

RANDOM = np.random.default_rng(0)


@pytest.mark.parametrize("direction", [None, (0.3, -0.5, 0.7)])
def test_task_jacobian_is_the_slope_of_the_error(direction: tuple | None) -> None:
    arm = mixed_arm(4)
    task = TipTask(arm, Target((0.1, 0.2, 0.3), direction))
    for w in [np.zeros((4, 2)), *random_postures(arm, 4, seed=1)]:
        numeric = differences(lambda x: task.error(x.reshape(4, 2)), w.reshape(8))
        assert_same_slopes(task.jacobian(w), -numeric)


def test_error_vanishes_at_the_target_alone() -> None:
    arm = mixed_arm(3)
    w, other = random_postures(arm, 2, seed=2)
    pose = arm_pose(w, arm)
    task = TipTask(arm, Target(pose[:3, 3], pose[:3, 2]))
    np.testing.assert_allclose(task.error(w), 0.0, atol=1e-15)
    assert task.distance_and_angle(w) == pytest.approx((0.0, 0.0), abs=1e-7)
    assert np.linalg.norm(task.error(other)) > 1e-3


@pytest.mark.parametrize(("rows", "columns"), [(3, 6), (6, 6), (6, 4), (3, 2)])
def test_undamped_step_is_least_squares_of_least_norm(rows: int, columns: int) -> None:
    jacobian, error = RANDOM.normal(size=(rows, columns)), RANDOM.normal(size=rows)
    np.testing.assert_allclose(damped_solve(jacobian, error, 0.0), np.linalg.lstsq(jacobian, error)[0], atol=1e-12)


def test_damped_step_solves_the_normal_equations() -> None:
    jacobian, error = RANDOM.normal(size=(3, 6)), RANDOM.normal(size=3)
    expected = np.linalg.solve(jacobian.T @ jacobian + 0.3 * np.eye(6), jacobian.T @ error)
    np.testing.assert_allclose(damped_solve(jacobian, error, 0.3), expected, atol=1e-12)


def test_singular_directions_are_left_alone() -> None:
    np.testing.assert_array_equal(damped_solve(np.diag([1.0, 0.0, 0.0]), np.ones(3), 0.0), [1.0, 0.0, 0.0])
    np.testing.assert_array_equal(damped_solve(np.zeros((3, 2)), np.ones(3), 0.0), [0.0, 0.0])


def test_converges_quadratically_near_the_answer() -> None:
    arm = mixed_arm(3)
    for w in random_postures(arm, 10, seed=3, largest=1.2):
        pose = arm_pose(w, arm)
        result = refine(arm, Target(pose[:3, 3], pose[:3, 2]), w + 0.02, tolerance=1e-10)
        assert result.status is IkStatus.SOLVED
        assert result.iterations <= 6


def test_slides_along_the_limit_to_an_answer_there() -> None:
    arm = arm_of(3, bend_limit=1.0)
    for w in random_postures(arm, 12, seed=9):
        w[1] /= bend(w[1])
        pose = arm_pose(w, arm)
        start = w + 0.1 * RANDOM.normal(size=(3, 2))
        start[1] /= bend(start[1])
        assert refine(arm, Target(pose[:3, 3], pose[:3, 2]), start, tolerance=1e-9).solved


def test_limits_hold_and_what_cannot_be_reached_is_no_convergence() -> None:
    arm = arm_of(2, bend_limit=0.5)
    result = refine(arm, Target((0.3, 0.0, 0.0)), start=np.full((2, 2), 2.0))
    assert result.status is IkStatus.NO_CONVERGENCE
    assert np.all(bend(result.configuration) <= 0.5 + 1e-12)
