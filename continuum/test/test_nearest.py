"""The nearest pose to a target out of reach is a minimum: the error pushes no section, but outward at a limit."""

import numpy as np
import pytest
from continuum_laws.limits import free_part
from continuum_laws.samples import arm_of, limited, mixed_arm, random_postures
from continuum_laws.targets import misses, targets_at

from continuum.arm import Arm
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.ik_target import DIRECTION, POSE, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics

ARMS = {
    "one": arm_of(1),
    "two": arm_of(2, 0.9),
    "three": arm_of(3, 1.4),
    "uneven": limited(arm_of(3), (0.05, 1.5, 3.0)),
    "mixed": limited(mixed_arm(3), (0.3, 1.0, 0.1)),
    "five": arm_of(5, 0.5),
}


@pytest.mark.parametrize("arm", ARMS.values(), ids=ARMS)
def test_the_error_pushes_no_section(arm: Arm) -> None:
    random = np.random.default_rng(1)
    positions = random.normal(size=(30, 3))
    positions *= arm.length * random.uniform(1.01, 2.0, (30, 1)) / np.linalg.norm(positions, axis=-1, keepdims=True)
    positions[0], positions[1] = (0.0, 0.0, 1.1 * arm.length), (0.0, 0.0, -1.2 * arm.length)
    batch = InverseKinematics(arm).solve_many(Targets(positions))
    assert set(batch.statuses) == {IkStatus.UNREACHABLE}
    for w, position in zip(batch.configurations, positions, strict=True):
        error = (position - arm_pose(w, arm)[:3, 3]) / np.linalg.norm(position)
        push = (arm_jacobian(w, arm)[:3] / arm.length).T @ error
        assert free_part(arm, w, push.reshape(-1, 2), np.zeros((1, w.size))) <= 1e-8


@pytest.mark.parametrize("kind", [DIRECTION, POSE], ids=["direction", "pose"])
def test_no_small_change_meets_position_and_rotation_better(kind: int) -> None:
    arm = arm_of(4, 1.2)
    reachable = targets_at(arm, random_postures(arm, 10, seed=2), kind)
    targets = Targets(reachable.positions + np.array([0.9, 0.0, 0.0]), reachable.directions, reachable.rotations)
    batch = InverseKinematics(arm).solve_many(targets)
    assert not np.any(batch.solved)

    def cost(configurations: np.ndarray) -> np.ndarray:
        distances, angles = misses(arm, configurations, targets)
        return np.hypot(distances, 0.1 * arm.length * angles)

    random = np.random.default_rng(3)
    for size in (1e-2, 1e-3):
        for _ in range(200):
            near = batch.configurations + size * random.normal(size=batch.configurations.shape)
            near *= np.minimum(1.0, 1.2 / bend(near))[..., None]
            assert np.all(cost(near) >= cost(batch.configurations) - 1e-12)


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
