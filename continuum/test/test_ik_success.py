"""Every reachable target is reached: any number of sections, alike or mixed, every kind of target, every tolerance."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of, limits_of, mixed_arm, random_postures
from continuum_laws.targets import misses, targets_at

from continuum.arm import Arm
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION
from continuum.kinematics.inverse_kinematics import InverseKinematics

N = 200
ARMS = {
    **{f"{n}_sections_90_degrees": arm_of(n, np.pi / 2) for n in (1, 2, 3, 5, 7)},
    **{f"{n}_sections_180_degrees": arm_of(n, np.pi, twist=0.3) for n in (1, 2, 3, 5, 7)},
    **{f"{n}_mixed_sections": mixed_arm(n) for n in (1, 2, 3, 5, 7)},
}


@pytest.mark.parametrize("tolerance", [1e-6, 1e-10])
@pytest.mark.parametrize("kind", [POSITION, DIRECTION, POSE], ids=["position", "direction", "pose"])
@pytest.mark.parametrize("arm", ARMS.values(), ids=ARMS)
def test_all_are_reached_from_straight_and_from_anywhere(arm: Arm, kind: int, tolerance: float) -> None:
    if kind == POSE and arm.n_sections < 3:
        kind = DIRECTION  # no target that such an arm could miss by its turn alone
    targets = targets_at(arm, random_postures(arm, N, seed=1), kind)
    ik = InverseKinematics(arm, tolerance)
    for starts in (None, random_postures(arm, N, seed=2)):
        batch = ik.solve_many(targets, starts)
        assert np.flatnonzero(~batch.solved).tolist() == []
        distances, angles = misses(arm, batch.configurations, targets)
        assert max(np.max(distances), np.max(angles)) <= tolerance + 1e-14
        np.testing.assert_allclose(batch.distances, distances, rtol=0, atol=1e-14)
        np.testing.assert_allclose(batch.angles, angles, rtol=0, atol=1e-14)
        assert np.all(bend(batch.configurations) <= limits_of(arm) + 1e-9)
