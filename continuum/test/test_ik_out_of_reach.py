"""Out of reach: the reported distance to the reachable set is that of a dense search, and the pose attains it."""

import numpy as np
import pytest
from continuum_laws.dense_search import distance_of_one_section, distance_of_sections
from continuum_laws.samples import arm_of, limited, limits_of, mixed_arm, random_postures
from continuum_laws.targets import misses, targets_at

from continuum.arm import Arm
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_result import IkBatch, IkStatus
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics

pytestmark = pytest.mark.slow

ARMS = {
    "one": arm_of(1),
    "one_short_bend": arm_of(1, 0.7),
    "one_mixed": mixed_arm(1),
    "two": arm_of(2),
    "two_short_bends": arm_of(2, 0.4),
    "two_uneven_bends": limited(arm_of(2), (2.0, 0.2)),
    "two_mixed": mixed_arm(2),
    "three": arm_of(3),
    "three_short_bends": arm_of(3, 0.5),
    "three_uneven_bends": limited(arm_of(3), (0.05, 1.5, 3.0)),
    "three_mixed": limited(mixed_arm(3), (0.3, 1.0, 0.1)),
}
each_arm = pytest.mark.parametrize("arm", ARMS.values(), ids=ARMS)


def answers_that_attain(arm: Arm, targets: Targets) -> IkBatch:
    """The solver's answers, after a look whether they obey the limits and lie where they say."""
    batch = InverseKinematics(arm).solve_many(targets)
    distances, angles = misses(arm, batch.configurations, targets)
    np.testing.assert_allclose(batch.distances, distances, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(batch.angles, angles, rtol=1e-9, atol=1e-9)
    assert np.all(bend(batch.configurations) <= limits_of(arm) + 1e-9)
    return batch


def assert_true_distances(arm: Arm, positions: np.ndarray, batch: IkBatch) -> None:
    search = distance_of_one_section if arm.n_sections == 1 else distance_of_sections
    for position, distance in zip(positions, batch.distances, strict=True):
        assert distance == pytest.approx(search(arm, position), rel=0, abs=1e-6)


def rows(batch: IkBatch, chosen: np.ndarray) -> IkBatch:
    """The chosen answers."""
    return IkBatch(*(values[chosen] for values in vars(batch).values()))


@each_arm
def test_farther_away_than_the_arm_is_long(arm: Arm) -> None:
    random = np.random.default_rng(1)
    directions = random.normal(size=(5, 3))
    directions[0], directions[1] = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
    lengths = random.uniform(1.01, 1.6, (5, 1)) * arm.length
    positions = lengths * directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    batch = answers_that_attain(arm, Targets(positions))
    assert set(batch.statuses) == {IkStatus.UNREACHABLE}
    assert_true_distances(arm, positions, batch)


@each_arm
def test_reachable_by_bending_beyond_the_limits_alone(arm: Arm) -> None:
    beyond = np.minimum(limits_of(arm) + 0.6, [0.99 * section.contact_bend for section in arm.sections])
    postures = random_postures(limited(arm, beyond), 20, seed=2)
    postures *= (beyond / bend(postures))[..., None]
    targets = targets_at(arm, postures, POSITION)
    batch = answers_that_attain(arm, targets)
    missed = np.flatnonzero(~batch.solved)[:4]
    assert len(missed) > 0 or arm is ARMS["three"]
    assert set(batch.statuses[missed]) <= {IkStatus.LIMIT_REACHED}
    assert_true_distances(arm, targets.positions[missed], rows(batch, missed))


@each_arm
def test_within_the_arm_s_length(arm: Arm) -> None:
    """Anywhere near the base: what is not solved is truly that far away."""
    random = np.random.default_rng(4)
    directions = random.normal(size=(5, 3))
    positions = random.uniform(0.1, 1.0, (5, 1)) * arm.length * directions
    positions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    batch = answers_that_attain(arm, Targets(positions))
    missed = ~batch.solved
    assert IkStatus.NO_CONVERGENCE not in batch.statuses
    assert_true_distances(arm, positions[missed], rows(batch, missed))


@pytest.mark.parametrize("kind", [DIRECTION, POSE], ids=["direction", "pose"])
@pytest.mark.parametrize("name", ["two", "three", "three_short_bends", "three_mixed"])
def test_no_random_posture_meets_position_and_rotation_better(name: str, kind: int) -> None:
    """A radian counts as much as a tenth of the arm's length."""
    arm = ARMS[name]
    away = targets_at(arm, random_postures(arm, 6, seed=5), kind)
    targets = Targets(1.4 * away.positions + [0.1, 0.0, 0.0], away.directions, away.rotations)
    batch = answers_that_attain(arm, targets)
    weight = 0.1 * arm.length
    postures = np.concatenate([random_postures(arm, 8000, seed=6), random_postures(arm, 2000, seed=7, largest=0.05)])
    for k in range(len(targets)):
        near = batch.configurations[k] + random_postures(arm, 500, seed=8, largest=1e-3)
        near *= np.minimum(1.0, limits_of(arm) / bend(near))[..., None]
        tried = np.concatenate([postures, near])
        repeated = Targets(
            *(
                None if values is None else np.repeat(values[k : k + 1], len(tried), axis=0)
                for values in (targets.positions, targets.directions, targets.rotations)
            )
        )
        distances, angles = misses(arm, tried, repeated)
        least = np.min(np.hypot(distances, weight * angles))
        assert np.hypot(batch.distances[k], weight * batch.angles[k]) <= least + 1e-9


def test_a_warm_start_stays_with_its_nearest_pose() -> None:
    """A target straight below is equally near from all sides: the arm that is there already stays on its side."""
    arm = arm_of(2, 1.0)
    ik, below = InverseKinematics(arm), Targets([[0.0, 0.0, -0.5]] * 8)
    first = ik.solve_many(below).configurations[0]
    for angle in (0.5, 2.0, -1.2):
        c, s = np.cos(angle), np.sin(angle)
        turned = first @ np.array([[c, s], [-s, c]])
        found = ik.follow(below, turned).configurations
        np.testing.assert_allclose(found, np.broadcast_to(turned, found.shape), rtol=0, atol=1e-6)
