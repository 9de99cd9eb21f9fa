"""The augmented filter and its smoother against the same Gaussian model written out as one vector."""

from dataclasses import replace

import numpy as np
from continuum_laws.strategies import LAW
from hypothesis import given
from hypothesis import strategies as st
from linear_gaussian import COLUMNS, Dense, LinearRun

from continuum.estimation.augmented_filter import RunLikelihood, run_likelihood, smoothed
from continuum.estimation.sensor_noise import NoiseModel

RUNS = st.builds(LinearRun.drawn, st.integers(0, 10**6), st.integers(1, 3), st.booleans(), st.integers(2, 12))
SEEDS = st.integers(0, 10**6)


def some_thetas(seed: int) -> np.ndarray:
    """None, small and large coefficients."""
    random = np.random.default_rng(seed)
    return np.stack([scale * random.normal(0, 1, COLUMNS) for scale in (0.0, 0.1, 1.0, 10.0)])


def likelihood(of: LinearRun, noise: NoiseModel | None = None) -> RunLikelihood:
    return run_likelihood(of.run, of.way, of.step, of.seen, of.columns, noise or of.noise)


def quadratic(found: RunLikelihood, theta: np.ndarray) -> float:
    """The part of -2 log p that depends on theta, and the energy of the data."""
    return float(found.energy - 2 * found.e @ theta + theta @ found.L @ theta)


def smoothed_at(of: LinearRun, theta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return smoothed(of.run, of.way, of.step, of.seen, of.added(theta), of.noise)


@LAW
@given(RUNS, SEEDS)
def test_one_pass_gives_the_dense_likelihood_at_any_coefficients(one: LinearRun, seed: int) -> None:
    found = likelihood(one)
    for theta in some_thetas(seed):
        dense = Dense(one, theta)
        np.testing.assert_allclose(quadratic(found, theta), dense.energy, rtol=1e-7)
        np.testing.assert_allclose(found.log_det, dense.log_det, rtol=1e-9, atol=1e-7)


@LAW
@given(RUNS, SEEDS, st.floats(0.1, 0.9), st.sampled_from([0.0, -3.0, 1e3, np.nan]))
def test_an_unmeasured_reading_has_no_information(one: LinearRun, seed: int, share: float, stand_in: float) -> None:
    """As one of very large variance, whatever stands in its place; but for a constant of the log-determinant."""
    partly, theta = one.with_unmeasured(seed, share, stand_in), some_thetas(seed)[-2]
    louder = replace(one.noise, sigma=3 * one.noise.sigma, white=2 * one.noise.white)
    found, found_louder = likelihood(partly), likelihood(partly, louder)
    dense, dense_louder = Dense(partly, theta), Dense(replace(partly, noise=louder), theta)
    np.testing.assert_allclose(quadratic(found, theta), dense.energy, rtol=1e-3, atol=1e-3)
    np.testing.assert_allclose(
        found_louder.log_det - found.log_det, dense_louder.log_det - dense.log_det, rtol=1e-4, atol=1e-3
    )


@LAW
@given(RUNS, SEEDS)
def test_smoothed_states_are_the_dense_conditional_ones(one: LinearRun, seed: int) -> None:
    for theta in some_thetas(seed)[1:3]:
        states, variances, _ = smoothed_at(one, theta)
        expected, left = Dense(one, theta).states()
        np.testing.assert_allclose(states, expected, rtol=1e-6, atol=1e-7)
        np.testing.assert_allclose(variances, left, rtol=1e-6, atol=1e-9)


@LAW
@given(RUNS, SEEDS, st.floats(0.1, 0.9))
def test_smoothed_states_need_no_unmeasured_readings(one: LinearRun, seed: int, share: float) -> None:
    partly, theta = one.with_unmeasured(seed, share, np.nan), some_thetas(seed)[1]
    states, variances, _ = smoothed_at(partly, theta)
    expected, left = Dense(partly, theta).states()
    np.testing.assert_allclose(states, expected, rtol=1e-3, atol=1e-3)
    np.testing.assert_allclose(variances, left, rtol=1e-3, atol=1e-6)


@LAW
@given(RUNS, SEEDS)
def test_whitened_innovations_carry_the_whole_energy(one: LinearRun, seed: int) -> None:
    """The smoother's own pass forward is the filter's."""
    for theta in some_thetas(seed):
        innovations = smoothed_at(one, theta)[2]
        np.testing.assert_allclose(np.sum(innovations**2), quadratic(likelihood(one), theta), rtol=1e-7)
