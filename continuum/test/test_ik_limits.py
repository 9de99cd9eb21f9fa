"""Bend limits in the compiled search: pulled back to them, slid along them, never beyond."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of, limited, limits_of, mixed_arm, random_postures
from continuum_laws.targets import misses, targets_at

from continuum.arm import Arm
from continuum.kinematics.compiled.arm_arrays import arm_arrays
from continuum.kinematics.compiled.limits import pull_within
from continuum.kinematics.configuration import bend, jones_from_allen
from continuum.kinematics.ik_target import POSE, POSITION
from continuum.kinematics.inverse_kinematics import OBJECTIVES, InverseKinematics


def test_only_sections_bent_too_far_are_pulled_back_and_keep_their_azimuth() -> None:
    arm = mixed_arm(5)
    for w in [np.zeros((5, 2)), *random_postures(arm, 20, seed=1, largest=8.0)]:
        back = w.copy()
        pull_within(arm_arrays(arm), back.reshape(-1))
        inside = bend(w) <= limits_of(arm)
        np.testing.assert_array_equal(back[inside], w[inside])
        np.testing.assert_allclose(bend(back)[~inside], limits_of(arm)[~inside], rtol=1e-14)
        np.testing.assert_allclose(jones_from_allen(back)[0], jones_from_allen(w)[0], atol=1e-14)


@pytest.mark.parametrize("objective", OBJECTIVES)
@pytest.mark.parametrize(
    "arm",
    [arm_of(3, 0.8), limited(arm_of(3), (0.05, 1.5, 3.0)), limited(mixed_arm(5), (0.3, 1.0, 0.1, 2.0, 0.5))],
    ids=["short_bends", "uneven_bends", "mixed"],
)
def test_targets_on_the_limits_are_reached_and_the_limits_kept(arm: Arm, objective: str) -> None:
    """One section, or all, at the limit: the answers slide there and do not go beyond."""
    postures = random_postures(arm, 60, seed=3)
    postures[:30, 1] *= (limits_of(arm)[1] / bend(postures[:30, 1]))[:, None]
    targets = targets_at(arm, postures, POSITION)
    batch = InverseKinematics(arm, 1e-8, objective).solve_many(targets, random_postures(arm, 60, seed=4))
    assert np.all(batch.solved)
    assert np.max(misses(arm, batch.configurations, targets)[0]) <= 1e-8 + 1e-14
    assert np.all(bend(batch.configurations) <= limits_of(arm) + 1e-9)


def test_a_start_beyond_the_limits_is_pulled_back() -> None:
    arm = arm_of(4, 0.6)
    targets = targets_at(arm, random_postures(arm, 40, seed=5), POSE)
    batch = InverseKinematics(arm).solve_many(targets, random_postures(arm, 40, seed=6, largest=4.0))
    assert np.all(batch.solved)
    assert np.all(bend(batch.configurations) <= 0.6 + 1e-9)
