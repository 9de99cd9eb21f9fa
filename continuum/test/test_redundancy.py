"""Freedom that a target leaves: used to stay near the start or to bend little, and never to the tip's harm."""

import numpy as np
import pytest
from continuum_laws.limits import free_part
from continuum_laws.samples import arm_of, limited, limits_of, mixed_arm, random_postures
from continuum_laws.targets import misses, targets_at

from continuum.arm import Arm
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_target import DIRECTION, POSITION
from continuum.kinematics.inverse_kinematics import InverseKinematics

pytestmark = pytest.mark.slow

N = 60
ARMS = {
    "two": (arm_of(2), POSITION),
    "three": (arm_of(3), POSITION),
    "three_direction": (arm_of(3, 2.0), DIRECTION),
    "three_short_bends": (arm_of(3, 0.8), POSITION),
    "four_mixed": (mixed_arm(4), POSITION),
    "five": (arm_of(5, np.pi / 2), DIRECTION),
    "seven": (limited(arm_of(7), (1.0, 0.4, 1.0, 0.2, 1.0, 0.3, 1.0)), POSITION),
}
each_arm = pytest.mark.parametrize(("arm", "kind"), ARMS.values(), ids=ARMS)


def free_push(arm: Arm, kind: int, w: np.ndarray, wish: np.ndarray) -> float:
    """Norm of ``wish`` (n_sections, 2) as far as tip and limits at ``w`` let it be followed [rad]."""
    jacobian, rotation = arm_jacobian(w, arm), arm_pose(w, arm)[:3, :3]
    return free_part(arm, w, wish, np.concatenate([jacobian[:3], (rotation.T @ jacobian[3:])[: kind - 3]]))


def answers(arm: Arm, kind: int, objective: str, starts: np.ndarray, tolerance: float) -> np.ndarray:
    """Configurations that solve the targets at the sample's postures and keep the limits."""
    targets = targets_at(arm, random_postures(arm, N, seed=1), kind)
    batch = InverseKinematics(arm, tolerance, objective).solve_many(targets, starts)
    assert np.all(batch.solved)
    distances, angles = misses(arm, batch.configurations, targets)
    assert max(np.max(distances), np.max(angles)) <= tolerance + 1e-14
    assert np.all(bend(batch.configurations) <= limits_of(arm) + 1e-9)
    return batch.configurations


def near_starts(arm: Arm) -> np.ndarray:
    """The sample's postures, moved by some degrees."""
    postures = random_postures(arm, N, seed=1)
    return postures + 0.05 * np.random.default_rng(2).normal(size=postures.shape)


@each_arm
@pytest.mark.parametrize("tolerance", [1e-6, 1e-10])
def test_from_a_start_some_degrees_away_no_answer_around_is_nearer(arm: Arm, kind: int, tolerance: float) -> None:
    starts = near_starts(arm)
    found = answers(arm, kind, "near_start", starts, tolerance)
    pushes = [free_push(arm, kind, w, start - w) for w, start in zip(found, starts, strict=True)]
    assert np.max(pushes) <= 1e-8


@each_arm
@pytest.mark.parametrize("tolerance", [1e-6, 1e-10])
def test_the_least_bent_answer_is_stationary(arm: Arm, kind: int, tolerance: float) -> None:
    found = answers(arm, kind, "least_bending", random_postures(arm, N, seed=2), tolerance)
    pushes = [free_push(arm, kind, w, -w) for w in found]
    assert np.max(pushes) <= 1e-8


@each_arm
@pytest.mark.parametrize("objective", ["near_start", "least_bending"])
def test_the_answer_is_no_farther_than_the_first_and_often_nearer(arm: Arm, kind: int, objective: str) -> None:
    starts = random_postures(arm, N, seed=2)
    reference = starts if objective == "near_start" else np.zeros_like(starts)
    first, best = (
        np.linalg.norm(answers(arm, kind, name, starts, 1e-10) - reference, axis=(1, 2))
        for name in ("first", objective)
    )
    assert np.all(best <= first + 1e-9)
    assert np.mean(best < 0.95 * first) > 0.2


def test_where_nothing_is_free_the_objective_changes_nothing() -> None:
    arm = arm_of(1)
    targets = targets_at(arm, random_postures(arm, 10, seed=3), POSITION)
    answers = [InverseKinematics(arm, 1e-10, o).solve_many(targets).configurations for o in ("first", "least_bending")]
    np.testing.assert_array_equal(*answers)
