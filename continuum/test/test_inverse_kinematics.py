"""The solver that nodes use: reachable targets are reached, of the others the nearest pose is told."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of, mixed_arm, random_postures
from continuum_laws.targets import HARD_DIRECTIONS, HARD_POSITIONS, MALFORMED_VECTORS, reachable_targets

from continuum.errors import InvalidValueError
from continuum.kinematics.bend_limits import at_limit, limits_of
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_result import IkResult, IkStatus, Target
from continuum.kinematics.inverse_kinematics import solve
from continuum.kinematics.nearest_pose import nearest_pose
from continuum.kinematics.tip_task import TipTask

UNREACHABLE = ((0.5, 0.3, 0.2), (0.0, 0.0, 0.9), (0.0, 0.4, -0.5), (1.0, -1.0, 0.0), (0.0, 0.0, -0.3))


def assert_tells_the_truth(result: IkResult, arm, position, direction=None) -> None:
    """The distances are those of the configuration, which obeys the limits, and the status follows from them."""
    distance, angle = TipTask(arm, Target(position, direction)).distance_and_angle(result.configuration)
    assert (result.distance, result.angle) == pytest.approx((distance, angle), rel=1e-12, abs=1e-15)
    assert np.all(bend(result.configuration) <= limits_of(arm) + 1e-9)
    assert result.solved == (result.distance <= 1e-6 and result.angle <= 1e-6)
    if result.status is IkStatus.LIMIT_REACHED:
        assert np.any(at_limit(result.configuration, arm))
    if result.status is IkStatus.UNREACHABLE:
        assert not np.any(at_limit(result.configuration, arm))


@pytest.mark.parametrize("largest", [np.pi / 2, np.pi], ids=["90_degrees", "180_degrees"])
@pytest.mark.parametrize("with_direction", [False, True])
def test_reachable_targets_are_reached(largest: float, with_direction: bool) -> None:
    arm = arm_of(3, bend_limit=largest)
    for position, direction in reachable_targets(arm, 25, seed=1):
        result = solve(arm, position, direction if with_direction else None)
        assert result.status is IkStatus.SOLVED
        assert_tells_the_truth(result, arm, position, direction if with_direction else None)


@pytest.mark.parametrize("n_sections", [1, 2, 5, 7])
def test_arms_of_any_number_of_mixed_sections_reach(n_sections: int) -> None:
    arm = mixed_arm(n_sections)
    for position, direction in reachable_targets(arm, 6, seed=n_sections):
        assert solve(arm, position, direction if n_sections > 2 else None).solved


def test_a_start_near_the_answer_leads_to_it() -> None:
    arm = arm_of(3)
    for w in random_postures(arm, 10, seed=2, largest=1.5):
        pose = arm_pose(w, arm)
        found = solve(arm, pose[:3, 3], pose[:3, 2], start=w + 1e-3).configuration
        np.testing.assert_allclose(found, w, rtol=0, atol=2e-3)


@pytest.mark.parametrize("position", UNREACHABLE)
def test_no_random_posture_comes_nearer_than_the_nearest_pose(position: tuple) -> None:
    arm = arm_of(3, bend_limit=1.4)
    result = solve(arm, position)
    assert result.status in (IkStatus.LIMIT_REACHED, IkStatus.UNREACHABLE)
    assert_tells_the_truth(result, arm, position)
    random = np.concatenate([random_postures(arm, 20000, seed=3), random_postures(arm, 5000, seed=4, largest=0.3)])
    tips = arm_pose(random, arm)[:, :3, 3]
    assert result.distance <= np.min(np.linalg.norm(tips - position, axis=-1)) + 1e-9


def test_beyond_the_tip_of_the_straight_arm_the_straight_arm_is_nearest() -> None:
    arm = arm_of(3)
    result = solve(arm, (0.0, 0.0, 2 * arm.length))
    assert result.status is IkStatus.UNREACHABLE
    assert result.distance == pytest.approx(arm.length, rel=1e-9)
    np.testing.assert_allclose(result.configuration, 0.0, atol=1e-4)


def test_a_target_beyond_the_bend_limits_alone_is_reported_so() -> None:
    wide, narrow = arm_of(2, bend_limit=2.5), arm_of(2, bend_limit=0.4)
    for w in random_postures(wide, 5, seed=5):
        w *= (2.4 / bend(w))[:, None]
        position = arm_pose(w, wide)[:3, 3]
        assert solve(wide, position).solved
        result = solve(narrow, position)
        assert result.status is IkStatus.LIMIT_REACHED
        assert_tells_the_truth(result, narrow, position)


@pytest.mark.parametrize("position", UNREACHABLE[:3])
def test_the_nearest_pose_cannot_be_bettered_by_a_small_change(position: tuple) -> None:
    """At the minimum the error pushes no section, but those at their limit outwards."""
    arm = arm_of(3, bend_limit=1.4)
    result = nearest_pose(arm, Target(position), random_postures(arm, 1, seed=6)[0])
    w, task = result.configuration, TipTask(arm, Target(position))
    push = (task.jacobian(w).T @ task.error(w)).reshape(-1, 2)
    for i, (held, row) in enumerate(zip(at_limit(w, arm), push, strict=True)):
        if held:
            radial = w[i] / bend(w[i])
            assert row @ radial >= -1e-6
            row = row - (row @ radial) * radial
        np.testing.assert_allclose(row, 0.0, atol=1e-6)


@pytest.mark.parametrize("position", HARD_POSITIONS)
@pytest.mark.parametrize("direction", [HARD_DIRECTIONS[0], HARD_DIRECTIONS[1], HARD_DIRECTIONS[-1]])
def test_a_hard_target_gets_a_status(position: tuple, direction: tuple | None) -> None:
    arm = arm_of(2)
    assert_tells_the_truth(solve(arm, position, direction), arm, position, direction)


@pytest.mark.parametrize("vector", MALFORMED_VECTORS)
def test_a_malformed_target_is_refused(vector: object) -> None:
    with pytest.raises(InvalidValueError, match=r"^position is "):
        solve(arm_of(2), vector)


@pytest.mark.parametrize("start", [np.zeros((3, 2)), [[0, np.nan], [0, 0]], "ab"])
def test_a_malformed_start_is_refused(start: object) -> None:
    with pytest.raises(InvalidValueError, match=r"^start is "):
        solve(arm_of(2), (0.1, 0.0, 0.2), start=start)
