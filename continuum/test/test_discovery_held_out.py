"""How well a run is predicted by the others, in models that are linear: what theory says, to the last digit."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from continuum.discovery.held_out import held_out_misfits
from continuum.identification.arrow_least_squares import FitStatus, Part, Unknowns
from continuum.identification.fit import Fit
from continuum.identification.free import Free

RUNS, WINDOWS, ERRORS, UNKNOWNS = 3, 2, 20, 4
SPREAD = np.array([1.0, 3.0, 0.5, 2.0])


def linear_fit(slopes: np.ndarray, measured: np.ndarray) -> Fit:
    """The best fit of errors that are slopes (runs, windows, m, k) times unknowns, less what was measured."""
    stacked = slopes.reshape(-1, UNKNOWNS)
    information = stacked.T @ stacked + np.diag(SPREAD**-2.0)
    best = np.linalg.solve(information, stacked.T @ measured.ravel())
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
def test_it_is_the_density_of_what_was_measured_given_the_other_runs(seed: int) -> None:
    slopes, measured = drawn(seed)
    found = held_out_misfits(linear_fit(slopes, measured))
    for number in range(RUNS):
        others = np.delete(slopes, number, axis=0).reshape(-1, UNKNOWNS)
        covariance = np.linalg.inv(others.T @ others + np.diag(SPREAD**-2.0))
        mean = covariance @ others.T @ np.delete(measured, number, axis=0).ravel()
        for window, seen, misfit in zip(slopes[number], measured[number], found[number], strict=True):
            of_it = multivariate_normal(window @ mean, np.eye(ERRORS) + window @ covariance @ window.T)
            assert misfit == pytest.approx(-2 * of_it.logpdf(seen) - ERRORS * np.log(2 * np.pi), rel=1e-6)


def test_what_one_run_alone_tells_is_not_held_against_it() -> None:
    """The others leave it as uncertain as it was; what it moves there is no misfit, but for its price."""
    slopes, _ = drawn(0)
    slopes[1:, :, :, 0] = 0.0
    slopes[0, 0, :, 0] *= 30.0
    noise = 0.7 * np.random.default_rng(1).normal(size=(RUNS, WINDOWS, ERRORS))
    alone = held_out_misfits(linear_fit(slopes, slopes @ np.array([0.8, 1.0, 0.2, -1.0]) + noise))[0][0]
    without = held_out_misfits(linear_fit(slopes, slopes @ np.array([0.0, 1.0, 0.2, -1.0]) + noise))[0][0]
    assert alone == pytest.approx(without, abs=5.0)
    assert alone < 2 * ERRORS


def test_rounding_makes_no_unknown_less_known_than_its_prior() -> None:
    """Of one that a single run tells, a hundred million times better than the prior, nothing is left but rounding."""
    slopes, _ = drawn(0)
    slopes[1:, :, :, 0] = 0.0
    slopes[0, :, :, 0] *= 1e9
    noise = 0.7 * np.random.default_rng(1).normal(size=(RUNS, WINDOWS, ERRORS))
    for run in held_out_misfits(linear_fit(slopes, noise)):
        assert np.all(run > 0)
        assert np.all(run < 6 * ERRORS)
