"""The nearest pose to a target out of reach is a minimum: the error pushes no section, but outward at a limit."""

import numpy as np
import pytest
from continuum_laws.limits import free_part
from continuum_laws.samples import arm_of, limited, mixed_arm

from continuum.arm import Arm
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.ik_target import Targets
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
