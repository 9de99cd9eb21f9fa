"""Eq. 11 from the cables to the tip: central differences, and the least variance of all left inverses."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_derivatives, geometric_jacobian
from continuum_laws.samples import mixed_arm, random_postures
from continuum_laws.strategies import LAW, arms_and_postures
from hypothesis import given

from continuum.arm import Arm
from continuum.kinematics.cable_twist import arm_configuration_cable_jacobian, tip_cable_jacobian
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.routing import tangle, tangle_jacobian, tangle_rates, untangle, untangle_rates

each_count = pytest.mark.parametrize("n_sections", range(1, 7))


def postures_of(arm: Arm, n_sections: int) -> np.ndarray:
    """Some within the limits, one of them straight."""
    w = random_postures(arm, 6, seed=n_sections)
    w[0] = 0.0
    return w


@each_count
def test_the_tip_moves_as_the_cables_do(n_sections: int) -> None:
    """Lengths change along a motion of the arm; the tip's twist is the slope of its pose by central differences."""
    arm = mixed_arm(n_sections)
    for k, w in enumerate(postures_of(arm, n_sections)):
        w_rate = np.random.default_rng(k).normal(size=w.shape)
        twist = geometric_jacobian(lambda t, w=w, rate=w_rate: arm_pose(w + t[..., None] * rate, arm), np.zeros(1))
        step = 1e-6
        rates = (tangle(w + step * w_rate, arm) - tangle(w - step * w_rate, arm)) / (2 * step)
        found = tip_cable_jacobian(w, arm) @ rates
        np.testing.assert_allclose(found, twist[:, 0], atol=1e-7 * np.abs(twist).max())


@each_count
def test_for_rates_of_a_motion_it_is_every_other_left_inverse(n_sections: int) -> None:
    arm = mixed_arm(n_sections)
    for w in postures_of(arm, n_sections):
        w_rate = np.random.default_rng(1).normal(size=w.shape)
        rates = tangle_rates(w, w_rate, arm)
        section_by_section = arm_jacobian(w, arm) @ untangle_rates(tangle(w, arm), rates, arm).reshape(-1)
        np.testing.assert_allclose(tip_cable_jacobian(w, arm) @ rates, section_by_section, atol=1e-9)


@LAW
@given(drawn=arms_and_postures())
def test_it_is_a_left_inverse_of_the_derivative_of_the_lengths(drawn: tuple[Arm, np.ndarray]) -> None:
    arm, w = drawn
    there_and_back = arm_configuration_cable_jacobian(w, arm) @ tangle_jacobian(w, arm)
    np.testing.assert_allclose(there_and_back, np.eye(2 * arm.n_sections), atol=1e-9)
    assert_same_derivatives(tip_cable_jacobian(w, arm) @ tangle_jacobian(w, arm), arm_jacobian(w, arm))


@each_count
def test_errors_of_measured_rates_move_it_less_than_section_by_section(n_sections: int) -> None:
    """Gauss and Markov: no linear unbiased estimate of a twist has less variance, in any direction."""
    arm = mixed_arm(n_sections)
    for w in postures_of(arm, n_sections):
        totals = tangle(w, arm)
        columns = [untangle_rates(totals, unit, arm).reshape(-1) for unit in np.eye(len(totals))]
        section_by_section = arm_jacobian(w, arm) @ np.stack(columns, axis=-1)
        found = tip_cable_jacobian(w, arm)
        more = section_by_section @ section_by_section.T - found @ found.T
        assert np.linalg.eigvalsh(more).min() > -1e-9 * np.linalg.norm(found) ** 2
        np.testing.assert_allclose(untangle(totals, arm), w, atol=1e-9)
