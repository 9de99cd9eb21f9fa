"""Many targets in one call: each answer is that of its target alone, always the same; trajectories do not jump."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of, mixed_arm, random_postures
from continuum_laws.targets import misses, targets_at

from continuum.errors import InvalidValueError
from continuum.kinematics.ik_result import IkBatch, IkResult, IkStatus
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION, Target, Targets
from continuum.kinematics.inverse_kinematics import OBJECTIVES, InverseKinematics


def one_of(targets: Targets, k: int) -> Target:
    """Target ``k`` alone."""
    return Target(*(None if v is None else v[k] for v in (targets.positions, targets.directions, targets.rotations)))


def with_some_out_of_reach(targets: Targets) -> Targets:
    """Every fifth position is moved far away."""
    positions = targets.positions.copy()
    positions[::5] *= 3.0
    return Targets(positions, targets.directions, targets.rotations)


def assert_same(one: IkResult, other: IkResult) -> None:
    assert (one.status, one.iterations, one.distance, one.angle) == (
        other.status, other.iterations, other.distance, other.angle,
    )  # fmt: skip
    np.testing.assert_array_equal(one.configuration, other.configuration)


@pytest.mark.parametrize("objective", OBJECTIVES)
@pytest.mark.parametrize("kind", [POSITION, DIRECTION, POSE], ids=["position", "direction", "pose"])
def test_each_row_is_the_answer_to_its_target_alone(kind: int, objective: str) -> None:
    arm = mixed_arm(4)
    targets = with_some_out_of_reach(targets_at(arm, random_postures(arm, 15, seed=1), kind))
    ik = InverseKinematics(arm, 1e-8, objective)
    starts = random_postures(arm, 15, seed=2)
    cold, warm = ik.solve_many(targets), ik.solve_many(targets, starts)
    assert len(cold) == 15
    assert {IkStatus(int(s)) for s in cold.statuses} == {IkStatus.SOLVED, IkStatus.UNREACHABLE}
    for k in range(15):
        assert_same(cold[k], ik.solve(one_of(targets, k)))
        assert_same(warm[k], ik.solve(one_of(targets, k), starts[k]))


def test_starts_are_left_alone() -> None:
    arm = arm_of(3)
    targets = targets_at(arm, random_postures(arm, 6, seed=4), POSITION)
    starts = random_postures(arm, 6, seed=5)
    before = starts.copy()
    ik = InverseKinematics(arm)
    ik.solve_many(targets, starts)
    ik.follow(targets, starts[0])
    ik.solve(one_of(targets, 0), starts[0])
    np.testing.assert_array_equal(starts, before)


def path(arm: object, kind: int, n: int = 300) -> tuple[np.ndarray, Targets]:
    """Configurations along a smooth closed curve, and their tips."""
    t = np.linspace(0.0, 2.0 * np.pi, n)[:, None, None]
    shift = np.arange(2 * arm.n_sections).reshape(1, arm.n_sections, 2)
    postures = 0.5 + 0.3 * np.sin(t + shift)
    return postures, targets_at(arm, postures, kind)


@pytest.mark.parametrize("kind", [POSITION, DIRECTION, POSE], ids=["position", "direction", "pose"])
@pytest.mark.parametrize("objective", ["first", "near_start"])
def test_a_trajectory_is_followed_without_jumps_each_answer_from_the_one_before(kind: int, objective: str) -> None:
    arm = arm_of(3)
    postures, targets = path(arm, kind)
    ik = InverseKinematics(arm, 1e-10, objective)
    batch = ik.follow(targets, postures[0])
    assert np.all(batch.solved)
    distances, angles = misses(arm, batch.configurations, targets)
    assert max(np.max(distances), np.max(angles)) <= 1e-10 + 1e-14
    params = np.max(np.abs(np.diff(postures, axis=0)))
    assert np.max(np.abs(np.diff(batch.configurations, axis=0))) <= 4.0 * params
    for k in (1, 7, 150, 299):
        assert_same(batch[k], ik.solve(one_of(targets, k), batch.configurations[k - 1]))
    assert_same(batch[0], ik.solve(one_of(targets, 0), postures[0]))


def test_a_start_near_the_answer_leads_to_it() -> None:
    arm = arm_of(3)
    postures = random_postures(arm, 200, seed=6, largest=1.5)
    batch = InverseKinematics(arm).solve_many(targets_at(arm, postures, POSE), postures + 1e-4)
    assert np.mean(np.max(np.abs(batch.configurations - postures), axis=(1, 2)) <= 5e-3) > 0.95
    batch = InverseKinematics(arm).solve_many(targets_at(arm, postures, POSITION), postures + 1e-3)
    assert np.max(np.abs(batch.configurations - postures)) <= 5e-3


def test_no_targets_give_no_answers() -> None:
    ik, none = InverseKinematics(arm_of(2)), Targets(np.zeros((0, 3)))
    for batch in (ik.solve_many(none), ik.follow(none), ik.solve_many(none, np.zeros((0, 2, 2)))):
        assert isinstance(batch, IkBatch)
        assert (len(batch), batch.configurations.shape) == (0, (0, 2, 2))


@pytest.mark.parametrize(
    "starts", [np.zeros((3, 2)), np.zeros((5, 2, 2)), np.full((4, 2, 2), np.nan), np.full((2, 2), np.inf), "ab", [[1]]]
)
def test_malformed_starts_are_refused(starts: object) -> None:
    arm = arm_of(2)
    targets = targets_at(arm, random_postures(arm, 4, seed=7), POSITION)
    with pytest.raises(InvalidValueError, match=r"^starts(\[\d\])? is "):
        InverseKinematics(arm).solve_many(targets, starts)
