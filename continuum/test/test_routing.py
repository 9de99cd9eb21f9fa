"""Tangle and untangle: total lengths are strings through all discs, and give every section's configuration back."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_derivatives, differences
from continuum_laws.rigid_links import total_cable_lengths
from continuum_laws.samples import mixed_arm, random_postures
from continuum_laws.strategies import LAW, arms_and_postures
from hypothesis import given

from continuum.arm import Arm
from continuum.kinematics.configuration import jones_from_allen
from continuum.kinematics.routing import (
    cables_through,
    section_length_rates,
    section_lengths,
    tangle,
    tangle_jacobian,
    tangle_rates,
    untangle,
    untangle_rates,
)

each_count = pytest.mark.parametrize("n_sections", range(1, 8))


@LAW
@given(drawn=arms_and_postures())
def test_total_lengths_are_distances_between_holes(drawn: tuple[Arm, np.ndarray]) -> None:
    """Also for cables that pass: parallel to the axis of the straight arm, whatever the twists between."""
    arm, w = drawn
    theta = jones_from_allen(w)[1]
    widest = [max(other.a for other in arm.sections[i:]) for i in range(arm.n_sections)]
    holes_meet = [
        2 * section.n_joints * np.arctan(section.b / a) for section, a in zip(arm.sections, widest, strict=True)
    ]
    w = w * np.minimum(1.0, holes_meet / np.maximum(theta, 1e-3))[:, None]  # beyond, a signed chord is no distance
    np.testing.assert_allclose(tangle(w, arm), total_cable_lengths(*jones_from_allen(w), arm), rtol=0, atol=1e-13)


@LAW
@given(drawn=arms_and_postures())
def test_tangle_and_untangle(drawn: tuple[Arm, np.ndarray]) -> None:
    arm, w = drawn
    np.testing.assert_allclose(untangle(tangle(w, arm), arm), w, rtol=0, atol=1e-12)


@each_count
def test_jacobian_is_the_derivative_of_the_totals(n_sections: int) -> None:
    arm = mixed_arm(n_sections)
    w = random_postures(arm, 10, seed=n_sections)
    w[0] = 0.0
    flat = w.reshape(len(w), -1)
    numeric = differences(lambda q: tangle(q.reshape(*q.shape[:-1], n_sections, 2), arm), flat)
    assert_same_derivatives(tangle_jacobian(w, arm), numeric)


@each_count
def test_rates_are_derivatives_of_the_totals(n_sections: int) -> None:
    arm = mixed_arm(n_sections)
    w = random_postures(arm, 10, seed=n_sections)
    w[0] = 0.0
    w_rate = np.random.default_rng(1).normal(size=w.shape)
    at = np.zeros((len(w), 1))
    numeric = differences(lambda t: tangle(w + t[..., None] * w_rate, arm), at)
    assert_same_derivatives(tangle_rates(w, w_rate, arm)[..., None], numeric)


@each_count
def test_untangled_rates_are_derivatives_of_the_untangled(n_sections: int) -> None:
    arm = mixed_arm(n_sections)
    totals = tangle(random_postures(arm, 10, seed=n_sections, largest=1.0), arm)
    rates = 1e-3 * np.random.default_rng(2).normal(size=totals.shape)
    numeric = differences(lambda t: untangle(totals + t * rates, arm), np.zeros((len(totals), 1)))[..., 0]
    np.testing.assert_allclose(untangle_rates(totals, rates, arm), numeric, rtol=0, atol=1e-9)


@each_count
def test_names_by_section_actuating_cables_first(n_sections: int) -> None:
    arm = mixed_arm(n_sections)
    assert cables_through(arm, 0).names == arm.cable_names
    for i, section in enumerate(arm.sections):
        routing = cables_through(arm, i)
        assert routing.names == tuple(name for later in arm.sections[i:] for name in later.cable_names)
        assert len(routing.names) == len(routing.a) == len(routing.azimuths)
        np.testing.assert_array_equal(routing.azimuths[: len(section.cable_azimuths)], section.cable_azimuths)


def test_totals_are_the_sum_of_what_each_section_spends() -> None:
    arm = mixed_arm(3)
    w = random_postures(arm, 1, seed=3)[0]
    w_rate = random_postures(arm, 1, seed=4)[0]
    spent = dict.fromkeys(arm.cable_names, 0.0)
    spent_rate = dict.fromkeys(arm.cable_names, 0.0)
    for i in range(3):
        names = cables_through(arm, i).names
        for name, length in zip(names, section_lengths(w[i], arm, i), strict=True):
            spent[name] += length
        for name, rate in zip(names, section_length_rates(w[i], w_rate[i], arm, i), strict=True):
            spent_rate[name] += rate
    np.testing.assert_allclose(tangle(w, arm), list(spent.values()), rtol=1e-15)
    np.testing.assert_allclose(tangle_rates(w, w_rate, arm), list(spent_rate.values()), rtol=1e-13)
