"""How well a run is predicted by the others, in models that are linear: what theory says, to the last digit."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from continuum.discovery.held_out import held_out_misfits
from continuum.identification.arrow_least_squares import FitStatus, Part, Unknowns, misfit_of, weight_of
from continuum.identification.fit import Fit
from continuum.identification.free import Free

RUNS, WINDOWS, ERRORS, UNKNOWNS = 3, 2, 20, 4
SPREAD = np.array([1.0, 3.0, 0.5, 2.0])
EQUAL = np.ones((RUNS, WINDOWS))


def linear_fit(slopes: np.ndarray, measured: np.ndarray, weights: np.ndarray = EQUAL) -> Fit:
    """The best fit of errors that are slopes (runs, windows, m, k) times unknowns, less what was measured."""
    weighted = (weights[:, :, None, None] * slopes).reshape(-1, UNKNOWNS).T
    information = weighted @ slopes.reshape(-1, UNKNOWNS) + np.diag(SPREAD**-2.0)
    best = np.linalg.solve(information, weighted @ measured.ravel())
    parts = [
        Part(window @ best - seen, window, np.zeros((ERRORS, 0)))
        for run, of_run in zip(slopes, measured, strict=True)
        for window, seen in zip(run, of_run, strict=True)
    ]
    far = np.full(UNKNOWNS, np.inf)
    nothing = [np.zeros(0)] * len(parts)
    space = SimpleNamespace(unknowns=tuple(Free("mass", j) for j in range(UNKNOWNS)), lower=-far, upper=far)
    run = SimpleNamespace(rows=range(WINDOWS), errors_by_window=np.full(WINDOWS, ERRORS))
    where = Unknowns(best, SPREAD, -far, far, nothing, nothing)
    simulator = SimpleNamespace(model=SimpleNamespace(n_joints=0))
    return Fit(FitStatus.CONVERGED, simulator, space, [run] * len(slopes), where, parts, 0.0, 1)  # type: ignore[arg-type]


def drawn(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Slopes, and measurements with less noise than 1, so that every window counts in full."""
    random = np.random.default_rng(seed)
    slopes = random.normal(size=(RUNS, WINDOWS, ERRORS, UNKNOWNS))
    return slopes, slopes @ random.normal(size=UNKNOWNS) + 0.7 * random.normal(size=(RUNS, WINDOWS, ERRORS))


@pytest.mark.parametrize("seed", range(5))
def test_it_is_the_density_of_what_was_measured_given_the_other_runs_and_the_windows_before(seed: int) -> None:
    slopes, measured = drawn(seed)
    found = held_out_misfits(linear_fit(slopes, measured))
    for number in range(RUNS):
        for window in range(WINDOWS):
            known = np.ones((RUNS, WINDOWS), dtype=bool)
            known[number, window:] = False
            others = slopes[known].reshape(-1, UNKNOWNS)
            covariance = np.linalg.inv(others.T @ others + np.diag(SPREAD**-2.0))
            mean, here = covariance @ others.T @ measured[known].ravel(), slopes[number, window]
            of_it = multivariate_normal(here @ mean, np.eye(ERRORS) + here @ covariance @ here.T)
            expected = -2 * of_it.logpdf(measured[number, window]) - ERRORS * np.log(2 * np.pi)
            assert found[number][window] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("times_better", [1.0, 30.0, 1000.0])
def test_an_unknown_that_one_run_alone_tells_is_paid_for_once(times_better: float) -> None:
    """Beside the model without it, where it is nothing: by Occam's factor, half the logarithm of what is gained."""
    slopes, _ = drawn(0)
    slopes[1:, :, :, 0] = 0.0
    slopes[0, :, :, 0] *= times_better
    noise = 0.7 * np.random.default_rng(1).normal(size=(RUNS, WINDOWS, ERRORS))
    without = slopes.copy()
    without[..., 0] = 0.0
    told = float(np.sum(slopes[..., 0] ** 2)) * SPREAD[0] ** 2
    paid = sum(run.sum() for run in held_out_misfits(linear_fit(slopes, noise))) - sum(
        run.sum() for run in held_out_misfits(linear_fit(without, noise))
    )
    assert 0 < paid < np.log(1 + told) + 1


def test_windows_of_a_run_have_to_agree_on_what_it_alone_tells() -> None:
    """One value each would explain them all: a run is no better predicted than the fit to it explains it."""
    slopes, _ = drawn(0)
    slopes[1:, :, :, 0] = 0.0
    slopes[0, :, :, 0] *= 5.0
    needed = slopes[0, :, :, 0] * np.array([1.0, -1.0])[:, None]
    measured = 0.3 * np.random.default_rng(1).normal(size=(RUNS, WINDOWS, ERRORS))
    measured[0] += 0.25 * needed
    fitted = linear_fit(slopes, measured)
    first, second = held_out_misfits(fitted)[0]
    assert first + second > sum(misfit_of(part) for part in fitted.parts[:WINDOWS])
    assert second > 2 * ERRORS


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("apart", [1.0, 2.0, 4.0])
def test_windows_that_no_value_explains_are_predicted_no_better_than_fitted(apart: float, seed: int) -> None:
    """Each would have another value; badly explained, it counts less, and agrees with the others no better for that."""
    slopes, measured = drawn(seed)
    other = apart * np.random.default_rng(100 + seed).normal(size=(RUNS, WINDOWS, UNKNOWNS))
    measured += np.einsum("rwmk,rwk->rwm", slopes, other)
    weights = EQUAL
    for _ in range(100):
        fitted = linear_fit(slopes, measured, weights)
        weights = np.reshape([weight_of(part) for part in fitted.parts], EQUAL.shape)
    assert np.min(weights) < 0.8
    for run, parts in zip(held_out_misfits(fitted), np.split(np.arange(RUNS * WINDOWS), RUNS), strict=True):
        assert run.sum() > sum(misfit_of(fitted.parts[i]) for i in parts)


def test_an_unknown_at_its_bound_stays_there() -> None:
    """The fit's gradient points out of it: no step of Newton's method starts there."""
    slopes, measured = drawn(0)
    free = linear_fit(slopes, measured)
    held = replace(
        free, space=SimpleNamespace(unknowns=free.space.unknowns, lower=free.coordinates, upper=-free.space.lower)
    )
    for run, parts in zip(held_out_misfits(held), np.split(np.arange(RUNS * WINDOWS), RUNS), strict=True):
        np.testing.assert_allclose(run, [misfit_of(free.parts[i]) for i in parts])


def test_rounding_makes_no_unknown_less_known_than_its_prior() -> None:
    """Of one that a single run tells, a hundred million times better than the prior, nothing is left but rounding."""
    slopes, _ = drawn(0)
    slopes[1:, :, :, 0] = 0.0
    slopes[0, :, :, 0] *= 1e9
    noise = 0.7 * np.random.default_rng(1).normal(size=(RUNS, WINDOWS, ERRORS))
    for run in held_out_misfits(linear_fit(slopes, noise)):
        assert np.all(run > 0)
        assert np.all(run < 6 * ERRORS)
