"""Bend limits: bringing a configuration back to them, and not going beyond."""

import numpy as np
from continuum_laws.samples import arm_of, mixed_arm, random_postures

from continuum.kinematics.bend_limits import at_limit, limits_of, within_limits, without_outward
from continuum.kinematics.configuration import bend, jones_from_allen


def test_only_sections_bent_too_far_are_brought_back_and_keep_their_azimuth() -> None:
    arm = mixed_arm(5)
    for w in [np.zeros((5, 2)), *random_postures(arm, 20, seed=1, largest=8.0)]:
        back = within_limits(w, arm)
        inside = bend(w) <= limits_of(arm)
        np.testing.assert_array_equal(back[inside], w[inside])
        np.testing.assert_allclose(bend(back)[~inside], limits_of(arm)[~inside], rtol=1e-14)
        np.testing.assert_allclose(jones_from_allen(back)[0], jones_from_allen(w)[0], atol=1e-14)
        assert np.array_equal(at_limit(back, arm), ~inside)


def test_a_section_at_its_limit_may_turn_and_unbend_but_not_bend_further() -> None:
    arm = arm_of(3, bend_limit=1.0)
    w = np.array([[0.6, 0.8], [0.6, 0.8], [0.3, 0.4]])  # the last is within its limit
    outward, inward = np.array([[0.6, 0.8]] * 3), -0.1 * np.array([[0.6, 0.8]] * 3)
    jacobian = np.random.default_rng(2).normal(size=(3, 6))
    np.testing.assert_array_equal(without_outward(jacobian, w, inward, arm), jacobian)
    held = without_outward(jacobian, w, outward, arm)
    np.testing.assert_allclose(held[:, :2] @ [0.6, 0.8], 0.0, atol=1e-15)
    np.testing.assert_allclose(held[:, :2] @ [-0.8, 0.6], jacobian[:, :2] @ [-0.8, 0.6], atol=1e-15)
    np.testing.assert_array_equal(held[:, 4:], jacobian[:, 4:])
    mixed = np.concatenate([outward[:1], inward[1:]])
    np.testing.assert_array_equal(without_outward(jacobian, w, mixed, arm)[:, 2:], jacobian[:, 2:])
