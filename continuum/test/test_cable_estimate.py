"""Configurations estimated from measured lengths: exact without noise, calibrated with it; misfits have a status."""

from dataclasses import replace

import numpy as np
import pytest
from continuum_laws.samples import arm_of, mixed_arm, random_postures
from continuum_laws.strategies import LAW, arms_and_postures
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import least_squares
from scipy.stats import chi2, kstest

from continuum.arm import Arm
from continuum.errors import InvalidValueError
from continuum.kinematics.cable_estimate import (
    CableEstimate,
    EstimateStatus,
    arm_of_cables,
    estimate_configuration,
)
from continuum.kinematics.routing import tangle, tangle_jacobian

SD = 1e-3
"""Of a measured length [m], where a test does not say another."""

each_count = pytest.mark.parametrize("n_sections", range(1, 7))
each_number_of_cables = pytest.mark.parametrize("n_cables", [3, 4, 6])


def arm_with(n_sections: int, n_cables: int) -> Arm:
    """Prototype sections turned about each other, with cables at equal distances."""
    azimuths = tuple(2 * np.pi * j / n_cables for j in range(n_cables))
    sections = arm_of(n_sections).sections
    return Arm(tuple(replace(one, cable_azimuths=azimuths, twist=0.4 * k) for k, one in enumerate(sections)))


def noisy_estimates(arm: Arm, noise: float, sd: float, n: int = 300) -> tuple[np.ndarray, list[CableEstimate]]:
    """Postures (n, n_sections, 2) [rad], and what is estimated of their lengths with an error of ``noise`` [m]."""
    w = random_postures(arm, n, seed=arm.n_sections)
    errors = noise * np.random.default_rng(len(arm.cable_names)).normal(size=(n, len(arm.cable_names)))
    return w, [estimate_configuration(one, arm, sd) for one in tangle(w, arm) + errors]


def whitened(w: np.ndarray, estimates: list[CableEstimate]) -> np.ndarray:
    """Errors (n, 2 n_sections) in standard deviations: of unit covariance where the stated one is right."""
    errors = [(one.w - true).reshape(-1) for true, one in zip(w, estimates, strict=True)]
    factors = [np.linalg.cholesky(one.covariance) for one in estimates]
    return np.array([np.linalg.solve(factor, error) for factor, error in zip(factors, errors, strict=True)])


@LAW
@given(drawn=arms_and_postures())
def test_lengths_of_a_posture_give_it_back(drawn: tuple[Arm, np.ndarray]) -> None:
    """Straight sections and largest bends among them."""
    arm, w = drawn
    found = estimate_configuration(tangle(w, arm), arm, SD)
    assert found.status is EstimateStatus.CONVERGED
    np.testing.assert_allclose(found.w, w, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found.residuals, 0.0, atol=1e-13)


@pytest.mark.slow
@each_number_of_cables
@each_count
def test_errors_are_as_large_as_the_covariance_says(n_sections: int, n_cables: int) -> None:
    w, estimates = noisy_estimates(arm_with(n_sections, n_cables), noise=SD, sd=SD)
    errors = whitened(w, estimates)
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(1.0, abs=0.1)
    within = np.sum(errors**2, axis=1) < chi2.ppf(0.9, 2 * n_sections)
    assert np.mean(within) == pytest.approx(0.9, abs=4 * np.sqrt(0.9 * 0.1 / len(within)))


@each_number_of_cables
@pytest.mark.parametrize("bend", [0.0, 1e-6, 5.0])
def test_the_covariance_holds_where_a_section_is_straight_or_bent_far(bend: float, n_cables: int) -> None:
    """5 rad are 0.92 of the bend where the discs' holes meet."""
    arm = Arm(tuple(replace(one, bend_limit=5.4) for one in arm_with(2, n_cables).sections))
    random = np.random.default_rng(n_cables)
    phi = random.uniform(-np.pi, np.pi, (300, 2))
    w = bend * np.stack([-np.sin(phi), np.cos(phi)], axis=-1)
    errors = SD * random.normal(size=(300, 2 * n_cables))
    estimates = [estimate_configuration(one, arm, SD) for one in tangle(w, arm) + errors]
    assert {one.status for one in estimates} == {EstimateStatus.CONVERGED}
    assert np.sqrt(np.mean(whitened(w, estimates) ** 2)) == pytest.approx(1.0, abs=0.1)


@pytest.mark.slow
@each_number_of_cables
@each_count
def test_chi_square_has_the_degrees_of_freedom_that_are_said(n_sections: int, n_cables: int) -> None:
    _, estimates = noisy_estimates(arm_with(n_sections, n_cables), noise=SD, sd=SD)
    (freedom,) = {one.degrees_of_freedom for one in estimates}
    assert freedom == n_sections * (n_cables - 2)
    assert kstest([one.chi_square for one in estimates], chi2(freedom).cdf).pvalue > 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("noise", [0.0, 1e-3, 2e-3, 3e-3])
@each_number_of_cables
@each_count
def test_no_noise_of_an_encoder_is_refused(n_sections: int, n_cables: int, noise: float) -> None:
    """The contract: up to 3 mm, and errors within 1.5 of the standard deviation that the covariance gives."""
    arm = arm_with(n_sections, n_cables)
    w, estimates = noisy_estimates(arm, noise, sd=max(noise, 1e-6), n=100)
    assert {one.status for one in estimates} == {EstimateStatus.CONVERGED}
    assert max(one.iterations for one in estimates) < 10
    error = np.mean([np.sum((one.w - true) ** 2) for true, one in zip(w, estimates, strict=True)])
    assert np.sqrt(error) <= 1.5 * np.sqrt(np.mean([np.trace(one.covariance) for one in estimates]))


@pytest.mark.slow
@each_number_of_cables
@each_count
def test_noise_at_a_bend_limit_is_not_refused_but_a_bend_beyond_it_is(n_sections: int, n_cables: int) -> None:
    arm, random = arm_with(n_sections, n_cables), np.random.default_rng(n_cables)
    limits = np.array([one.bend_limit for one in arm.sections])
    phi = random.uniform(-np.pi, np.pi, (100, n_sections))
    w = limits[:, None] * np.stack([-np.sin(phi), np.cos(phi)], axis=-1)
    errors = 3 * SD * random.normal(size=(100, len(arm.cable_names)))
    estimates = [estimate_configuration(one, arm, 3 * SD) for one in tangle(w, arm) + errors]
    assert {one.status for one in estimates} == {EstimateStatus.CONVERGED}
    beyond = np.array([np.hypot(*one.w.T) > limits for one in estimates])
    assert np.mean(beyond) == pytest.approx(0.5, abs=4 * 0.5 / np.sqrt(beyond.size))
    far = w[0] * (1.0 + 10 * estimates[0].bend_sd(0) / limits[:, None])
    found = estimate_configuration(tangle(far, arm), arm, 3 * SD)
    assert found.status is EstimateStatus.BEYOND_LIMIT


@each_count
def test_an_independent_search_finds_nothing_more_likely(n_sections: int) -> None:
    arm = mixed_arm(n_sections)
    random = np.random.default_rng(n_sections)
    for w in random_postures(arm, 5, seed=n_sections):
        totals = tangle(w, arm) + 3e-3 * random.normal(size=len(arm.cable_names))
        found = estimate_configuration(totals, arm, 3e-3)
        search = least_squares(
            lambda q, totals=totals: totals - tangle(q.reshape(-1, 2), arm), w.reshape(-1), ftol=1e-14, xtol=1e-14
        )
        assert np.sum(found.residuals**2) <= 2 * search.cost * (1 + 1e-6)
        np.testing.assert_allclose(found.w.reshape(-1), search.x, atol=1e-3 * np.sqrt(found.covariance.max()))
        slope = tangle_jacobian(found.w, arm).T @ found.residuals
        assert np.abs(slope).max() < 1e-3 * np.abs(tangle_jacobian(found.w, arm)).max() * np.abs(found.residuals).max()


@LAW
@given(drawn=arms_and_postures(), data=st.data())
def test_cables_may_be_missing_while_each_section_keeps_three(drawn: tuple[Arm, np.ndarray], data) -> None:
    arm, w = drawn
    kept: list[bool] = []
    for section in arm.sections:
        n = len(section.cable_azimuths)
        some = data.draw(st.lists(st.booleans(), min_size=n, max_size=n).filter(lambda one: sum(one) >= 3))
        kept += some
    known = np.array(kept)
    found = estimate_configuration(np.where(known, tangle(w, arm), np.nan), arm, SD)
    assert found.status is EstimateStatus.CONVERGED
    np.testing.assert_allclose(found.w, w, atol=1e-9)
    assert found.degrees_of_freedom == known.sum() - 2 * arm.n_sections
    np.testing.assert_array_equal(np.isnan(found.residuals), ~known)
    fewer = arm_of_cables(arm, tuple(kept))
    assert fewer is not None
    np.testing.assert_allclose(tangle(w, fewer), tangle(w, arm)[known], atol=1e-14)


@each_count
def test_two_cables_of_a_section_do_not_determine_it(n_sections: int) -> None:
    arm = arm_with(n_sections, 4)
    totals = tangle(random_postures(arm, 1, seed=1)[0], arm)
    totals[-2:] = np.nan
    found = estimate_configuration(totals, arm, SD)
    assert found.status is EstimateStatus.UNDETERMINED
    assert np.isnan(found.w).all()
    assert np.isnan(found.covariance).all()


@each_number_of_cables
@each_count
def test_a_length_that_is_wrong_is_beyond_the_tolerance(n_sections: int, n_cables: int) -> None:
    """Of the last section one cable: nothing but two coordinates can follow it, here without crossing their limit."""
    arm = arm_with(n_sections, n_cables)
    for w in 0.8 * random_postures(arm, 20, seed=3):
        totals = tangle(w, arm)
        totals[-1] += 30 * SD
        found = estimate_configuration(totals, arm, SD)
        assert found.status is EstimateStatus.BEYOND_TOLERANCE
        assert estimate_configuration(totals, arm, SD, tolerance=30 * SD).status is EstimateStatus.INCONSISTENT
        assert estimate_configuration(totals, arm, 30 * SD).status is EstimateStatus.CONVERGED


def test_noise_that_is_larger_than_said_is_inconsistent() -> None:
    arm = arm_with(6, 6)
    _, estimates = noisy_estimates(arm, noise=3 * SD, sd=SD, n=20)
    assert {one.status for one in estimates} <= {EstimateStatus.INCONSISTENT, EstimateStatus.BEYOND_TOLERANCE}
    w = random_postures(arm, 1, seed=2)[0]
    off = 3 * SD * np.random.default_rng(2).normal(size=len(arm.cable_names))
    found = estimate_configuration(tangle(w, arm) + off, arm, SD, tolerance=1.0)
    assert found.status is EstimateStatus.INCONSISTENT


@each_count
def test_any_finite_lengths_have_an_answer(n_sections: int) -> None:
    arm = mixed_arm(n_sections)
    random = np.random.default_rng(n_sections)
    for scale in (0.1, 1.0, 100.0, 1e200):
        found = estimate_configuration(scale * random.normal(size=len(arm.cable_names)), arm, SD)
        assert found.status in (EstimateStatus.BEYOND_TOLERANCE, EstimateStatus.UNDETERMINED)


@pytest.mark.parametrize(("totals", "sd"), [([0.1] * 3, SD), ([0.1] * 3 + [np.inf], SD), ([0.1] * 4, 0.0)])
def test_what_is_no_measurement_is_refused(totals: list[float], sd: float) -> None:
    with pytest.raises(InvalidValueError, match="allowed"):
        estimate_configuration(totals, arm_of(1), sd)


def test_covariance_of_a_section_is_its_block() -> None:
    arm = arm_with(3, 4)
    found = estimate_configuration(tangle(random_postures(arm, 1, seed=0)[0], arm), arm, SD)
    np.testing.assert_array_equal(found.section_covariance(1), found.covariance[2:4, 2:4])
    double = estimate_configuration(tangle(random_postures(arm, 1, seed=0)[0], arm), arm, 2 * SD)
    np.testing.assert_allclose(double.covariance, 4 * found.covariance, rtol=1e-9)
