"""Bends beyond half a turn, targets in the corners of the limits, targets very far away: right answers and statuses."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of, limited, limits_of, mixed_arm, random_postures
from continuum_laws.targets import misses, targets_at

from continuum.arm import Arm
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.compiled.arm_arrays import arm_arrays
from continuum.kinematics.compiled.task import target_of
from continuum.kinematics.compiled.two_sections import MOST_CANDIDATES, fill_candidates
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION, Target, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics

pytestmark = pytest.mark.slow

KINDS = {
    "one": (1, POSITION),
    "two": (2, DIRECTION),
    "three": (3, DIRECTION),
    "three_pose": (3, POSE),
    "four": (4, POSE),
}
each_kind = pytest.mark.parametrize(("n", "kind"), KINDS.values(), ids=KINDS)


def bent(arm: Arm, least: float, most: float, n: int, seed: int = 1) -> np.ndarray:
    """Postures (n, n_sections, 2) [rad] with every bend between ``least`` and ``most`` [rad]."""
    postures = random_postures(arm, n, seed=seed)
    bends = np.random.default_rng(seed).uniform(least, most, bend(postures).shape)
    return postures * (bends / bend(postures))[..., None]


@each_kind
@pytest.mark.parametrize("limit", [4.0, 5.3])
def test_bends_beyond_half_a_turn_are_found(n: int, kind: int, limit: float) -> None:
    arm = arm_of(n, limit, twist=0.4)
    targets = targets_at(arm, bent(arm, 0.0, limit, 300), kind)
    batch = InverseKinematics(arm).solve_many(targets)
    assert np.flatnonzero(~batch.solved).tolist() == []
    distances, angles = misses(arm, batch.configurations, targets)
    assert max(np.max(distances), np.max(angles)) <= 1e-6 + 1e-14
    assert np.all(bend(batch.configurations) <= limit + 1e-9)


@each_kind
def test_what_bends_beyond_the_limits_alone_reach_is_reported_so(n: int, kind: int) -> None:
    arm = arm_of(n, np.pi, twist=0.4)
    targets = targets_at(arm, bent(arm, 3.2, 5.3, 200), kind)
    assert set(InverseKinematics(arm).solve_many(targets).statuses) <= {IkStatus.SOLVED, IkStatus.LIMIT_REACHED}


def test_two_sections_have_a_candidate_near_every_answer() -> None:
    """So that neither chance nor restarts decide whether two sections can reach a position and a direction."""
    arm = arm_of(2, 5.3, twist=0.4)
    postures = bent(arm, 0.05, 5.3, 300, seed=3)
    targets = targets_at(arm, postures, DIRECTION)
    off = []
    for row, posture in zip(targets.rows, postures, strict=True):
        candidates = np.empty((MOST_CANDIDATES, 4))
        count = fill_candidates.py_func(arm_arrays(arm), target_of(row, 0.1 * arm.length), candidates)
        off.append(np.min(np.max(np.abs(candidates[:count] - posture.reshape(-1)), axis=1), initial=np.inf))
    assert np.quantile(off, 0.99) <= 0.02


@pytest.mark.parametrize(
    ("arm", "kind"),
    [
        (arm_of(2, np.pi), DIRECTION),
        (arm_of(3, 0.5), POSE),
        (arm_of(3, 1.5, twist=0.2), POSE),
        (limited(mixed_arm(3), (1.43, 1.3, 1.2)), DIRECTION),
        (limited(arm_of(3, np.pi, twist=0.5), (1.43, 3.14, 3.14)), DIRECTION),
    ],
    ids=["half_turns", "short_bends", "pose", "mixed", "uneven"],
)
def test_all_sections_at_their_limit(arm: Arm, kind: int) -> None:
    postures = bent(arm, 1.0, 1.0, 1000) * limits_of(arm)[:, None]
    batch = InverseKinematics(arm).solve_many(targets_at(arm, postures, kind))
    assert np.flatnonzero(~batch.solved).tolist() == []
    assert np.all(bend(batch.configurations) <= limits_of(arm) + 1e-9)


@pytest.mark.parametrize("n", [3, 7, 10])
@pytest.mark.parametrize("largest", [1e-3, 1e-2, 0.05])
def test_nearly_straight_arms_are_at_no_limit(n: int, largest: float) -> None:
    arm = arm_of(n, twist=0.3)
    for kind in (POSITION, DIRECTION, POSE):
        batch = InverseKinematics(arm, 1e-9).solve_many(targets_at(arm, bent(arm, 0.0, largest, 60), kind))
        assert np.flatnonzero(~batch.solved).tolist() == []


@pytest.mark.parametrize("length", [1e6, 1e10, 1e100, 1e155, 1e300])
@pytest.mark.parametrize("direction", [None, (0.0, 1.0, 0.0)])
def test_the_farthest_targets_have_a_nearest_pose_too(length: float, direction: tuple | None) -> None:
    """The arm stretches out towards it, and the distance is that from the tip."""
    arm = arm_of(3, 0.6)
    for towards in np.array([[0.6, 0.0, 0.8], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]):
        result = InverseKinematics(arm).solve(Target(length * towards, direction))
        tip = arm_pose(result.configuration, arm)[:3, 3]
        assert result.status is IkStatus.UNREACHABLE
        assert result.distance == pytest.approx(np.hypot.reduce(length * towards - tip), rel=1e-15)
        tips = arm_pose(random_postures(arm, 3000, seed=1), arm)[:, :3, 3]
        assert tip @ towards >= np.max(tips @ towards) - 1e-4


def test_the_least_bent_of_the_answers_to_a_full_pose() -> None:
    """They are discrete: never a more bent one than the first, and often a less bent one."""
    arm = arm_of(3)
    targets = targets_at(arm, random_postures(arm, 150, seed=4), POSE)
    first, least = (
        np.linalg.norm(InverseKinematics(arm, 1e-9, name).solve_many(targets).configurations, axis=(1, 2))
        for name in ("first", "least_bending")
    )
    assert np.all(least <= first + 1e-6)
    assert np.mean(least < 0.99 * first) > 0.1


@pytest.mark.parametrize("seed", [103, 114, 117])
def test_least_bending_does_not_jump_along_a_trajectory(seed: int) -> None:
    """Where the least bent answers, each by itself, do."""
    arm, random, part = arm_of(3), np.random.default_rng(seed), np.linspace(0.0, 1.0, 300)[:, None]
    ends = random.uniform(-0.35, 0.35, (2, 3)) * arm.length
    ends[:, 2] = random.uniform(0.1, 0.6, 2) * arm.length
    turned = random.normal(size=(2, 3))
    targets = Targets(ends[0] + part * (ends[1] - ends[0]), turned[0] + part * (turned[1] - turned[0]))
    ik = InverseKinematics(arm, 1e-9, "least_bending")
    path, alone = ik.follow(targets), ik.solve_many(targets)
    assert np.all(path.solved)
    assert np.max(np.abs(np.diff(path.configurations, axis=0))) <= 0.2
    assert np.max(np.abs(np.diff(alone.configurations, axis=0))) >= 1.0
