"""Rates of the configurations for a velocity of the tip: exact where that is possible, small where it is not."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of, mixed_arm, random_postures

from continuum.kinematics.chain import arm_jacobian
from continuum.kinematics.configuration import bend
from continuum.kinematics.differential import configuration_rate, least_bending
from continuum.kinematics.section import configuration_from_point_jacobian, section_position

VELOCITY = np.array([0.05, -0.03, 0.02])


def far_from_limits(n_sections: int) -> tuple:
    arm = mixed_arm(n_sections)
    return arm, [w for w in random_postures(arm, 20, seed=n_sections, largest=1.2) if np.all(bend(w) > 0.3)]


@pytest.mark.parametrize("n_sections", [2, 3, 5])
@pytest.mark.parametrize("wish_gain", [None, 1.0])
def test_the_tip_moves_as_asked(n_sections: int, wish_gain: float | None) -> None:
    arm, postures = far_from_limits(n_sections)
    regular = 0
    for w in postures:
        jacobian = arm_jacobian(w, arm)[:3]
        values = np.linalg.svd(jacobian, compute_uv=False)
        if values[-1] > 0.02 * values[0]:
            regular += 1
            wish = None if wish_gain is None else least_bending(w, wish_gain)
            rate = configuration_rate(jacobian, VELOCITY, w, arm, wish)
            np.testing.assert_allclose(jacobian @ rate.reshape(-1), VELOCITY, rtol=0, atol=1e-13)
    assert regular > 0


def test_without_a_wish_the_rate_is_the_smallest() -> None:
    arm, postures = far_from_limits(3)
    jacobian = arm_jacobian(postures[0], arm)[:3]
    rate = configuration_rate(jacobian, VELOCITY, postures[0], arm)
    np.testing.assert_allclose(rate.reshape(-1), np.linalg.pinv(jacobian) @ VELOCITY, atol=1e-12)


def test_the_wish_is_followed_as_far_as_the_tip_does_not_notice() -> None:
    arm, postures = far_from_limits(3)
    w = postures[0]
    jacobian = arm_jacobian(w, arm)[:3]
    wish = least_bending(w, 2.0)
    with_wish, without = (configuration_rate(jacobian, VELOCITY, w, arm, r) for r in (wish, None))
    extra = (with_wish - without).reshape(-1)
    null = np.eye(6) - np.linalg.pinv(jacobian) @ jacobian
    np.testing.assert_allclose(extra, null @ wish.reshape(-1), atol=1e-12)
    assert extra @ wish.reshape(-1) > 0


def test_least_bending_is_down_the_slope_of_the_bend() -> None:
    w = np.array([[0.3, -0.4], [0.0, 0.0]])
    np.testing.assert_array_equal(least_bending(w, 2.0), [[-0.6, 0.8], [0.0, 0.0]])


def test_one_section_follows_eq_22() -> None:
    """A velocity that the tip of one section can have gives the rate of Eq. 22."""
    arm = arm_of(1)
    for w in random_postures(arm, 10, seed=1, largest=2.0):
        jacobian = arm_jacobian(w, arm)[:3]
        velocity = jacobian @ [0.4, -0.2]
        eq_22 = configuration_from_point_jacobian(section_position(w, arm.sections[0]))[0] @ velocity
        np.testing.assert_allclose(configuration_rate(jacobian, velocity, w, arm)[0], eq_22, atol=1e-10)


@pytest.mark.parametrize("bend_of_all", [0.0, 1e-12, 1e-6, 1e-3])
def test_near_the_straight_arm_the_rate_stays_small(bend_of_all: float) -> None:
    """The straight arm cannot move along its axis; asked to, it neither jumps nor fails."""
    arm = arm_of(3)
    w = np.full((3, 2), bend_of_all)
    rate = configuration_rate(arm_jacobian(w, arm)[:3], np.array([0.0, 0.0, -0.1]), w, arm)
    assert np.max(np.abs(rate)) < 20.0


@pytest.mark.parametrize("wish_gain", [0.0, 0.1, 1.0])
def test_a_section_at_its_limit_is_held_and_the_tip_still_moves_as_asked(wish_gain: float) -> None:
    arm = arm_of(3, bend_limit=1.0)
    n_held = 0
    for w in random_postures(arm, 60, seed=3):
        w[1] *= 1.0 / bend(w[1])
        jacobian = arm_jacobian(w, arm)[:3]
        rate = configuration_rate(jacobian, 5 * VELOCITY, w, arm, least_bending(w, wish_gain))
        assert rate[1] @ w[1] <= 1e-12
        values = np.linalg.svd(jacobian, compute_uv=False)
        if rate[1] @ w[1] >= -1e-12 and values[-1] > 0.1 * values[0]:
            n_held += 1
            np.testing.assert_allclose(jacobian @ rate.reshape(-1), 5 * VELOCITY, rtol=0, atol=1e-12)
    assert n_held > 3
