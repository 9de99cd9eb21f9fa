"""Fits to an arm whose truth is known: what comes back, what the data cannot tell, and intervals that hold."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from identification_laws import ANGLE_NOISE, BENDS, PULLS, RATE_NOISE, recorded, releases, small_simulator, white_noise

from continuum.discovery.trial import TOLERANCES
from continuum.dynamics.tensions import Tensions
from continuum.errors import InvalidValueError
from continuum.identification.arrow_least_squares import FitStatus
from continuum.identification.bootstrap import bootstrap, interval, moves_without
from continuum.identification.drawn_models import drawn_models
from continuum.identification.fisher import identifiability
from continuum.identification.fit import Fit, fit
from continuum.identification.free import Free
from continuum.identification.free_run import free_run
from continuum.identification.recording import Recording
from continuum.identification.tension_rows import jumps_tell, with_likelier_rows

SIMULATOR = small_simulator()
ROUGH = small_simulator(None, TOLERANCES)
"""As exact as diagnoses are."""
NOMINAL = SIMULATOR.model.values()
TRUTH = {"stiffness": 1.5, "viscous_friction": 0.025, "coulomb_friction": 0.05}
FREE = tuple(Free(name) for name in TRUTH)


@lru_cache
def fitted_releases(seed: int) -> Fit:
    return fit(ROUGH, releases(2, SIMULATOR, seed, TRUTH), white_noise(), FREE)


def deviations(fitted: Fit) -> np.ndarray:
    """Textbook standard deviations of the unknowns, in their units."""
    return np.asarray(fitted.space.scale * np.sqrt(np.diag(np.linalg.inv(fitted.information))))


def values(fitted: Fit) -> np.ndarray:
    return np.array([fitted.value(unknown) for unknown in FREE])


@pytest.mark.parametrize("seed", range(5))
def test_parameters_come_back(seed: int) -> None:
    fitted = fitted_releases(seed)
    assert fitted.status is FitStatus.CONVERGED
    off = (values(fitted) - np.array(list(TRUTH.values()))) / deviations(fitted)
    assert np.all(np.abs(off) < 3)
    assert deviations(fitted)[0] < 0.02 * TRUTH["stiffness"]
    assert sum(run.sum() for run in fitted.misfits) == pytest.approx(fitted.n_errors, rel=0.2)


@pytest.mark.parametrize("signs", [(1, 1, 1), (-1, 1, -1), (1, -1, 1), (-1, -1, -1)])
def test_wrong_starts_end_at_the_same_place(signs: tuple[int, ...]) -> None:
    best = fitted_releases(0)
    start = best.coordinates + 0.3 * np.array(signs) * (1 + best.coordinates)
    fitted = fit(ROUGH, releases(2, SIMULATOR, 0, TRUTH), white_noise(), FREE, start)
    assert fitted.status is FitStatus.CONVERGED
    assert np.all(np.abs(values(fitted) - values(best)) < deviations(best))


def test_a_fit_without_rates() -> None:
    blind = [replace(run, theta_rate=None) for run in releases(2, SIMULATOR, 1, TRUTH)]
    fitted = fit(ROUGH, blind, white_noise(rate=None), FREE)
    assert np.all(np.abs(values(fitted) - np.array(list(TRUTH.values()))) < 3 * deviations(fitted))


def test_what_is_one_recordings_own_is_found_for_each() -> None:
    """Offsets of sensors that were switched on anew for every run."""
    simulator, random = small_simulator("angle_offset"), np.random.default_rng(5)
    offsets = np.radians([3.0, -2.0])
    runs = [
        replace(run, theta=run.theta + np.array([0.0, offset]))
        for run, offset in zip((recorded(simulator, bend, random) for bend in BENDS[:2]), offsets, strict=True)
    ]
    free = [Free("stiffness"), *(Free("angle_offset.offset", 1, i) for i in range(2))]
    fitted = fit(small_simulator("angle_offset", TOLERANCES), runs, white_noise(), free)
    found = fitted.space.amounts(fitted.coordinates)[1:]
    np.testing.assert_allclose(found, offsets, atol=3 * np.max(deviations(fitted)[1:]))
    assert np.max(deviations(fitted)[1:]) < np.radians(0.5)
    np.testing.assert_array_equal(fitted.model.values()["angle_offset.offset"], 0.0)
    assert fitted.model.values()["stiffness"][0] == pytest.approx(fitted.value(free[0]))


def test_an_effects_size_comes_back_where_its_states_run_on() -> None:
    truth, random = {"actuator_lag.lag": 0.05}, np.random.default_rng(6)
    simulator = small_simulator("actuator_lag")
    runs = [recorded(simulator, bend, random, truth, tensions=PULLS) for bend in BENDS[:2]]
    free = [Free("stiffness"), Free("actuator_lag.lag")]
    fitted = fit(small_simulator("actuator_lag", TOLERANCES), runs, white_noise(), free, np.array([0.0, 1.0]))
    assert abs(fitted.value(free[1]) - 0.05) < 3 * deviations(fitted)[1] < 0.02


def test_a_run_in_which_something_knocked_does_not_decide() -> None:
    runs = releases(2, SIMULATOR, 0, TRUTH)
    theta = runs[0].theta.copy()
    theta[20:26] += 0.3
    fitted = fit(ROUGH, [replace(runs[0], theta=theta), runs[1]], white_noise(), FREE)
    assert np.all(np.abs(values(fitted) - np.array(list(TRUTH.values()))) < 4 * deviations(fitted))


def test_simulations_are_counted_window_by_window() -> None:
    fitted = fitted_releases(0)
    counted = sum(run.windows_simulated / len(run.rows) for run in fitted.runs)
    assert fitted.simulations == round(counted)
    assert 4 < fitted.simulations < 200


def test_unknowns_that_a_model_does_not_have() -> None:
    with pytest.raises(InvalidValueError, match="free parameter is 'springiness'"):
        fit(ROUGH, releases(1, SIMULATOR, 0), white_noise(), [Free("springiness")])


def test_what_the_data_cannot_tell_is_named() -> None:
    """No cable pulls in a release, so nothing is seen of its friction."""
    unknowns = (*FREE, Free("capstan_friction"))
    free = identifiability(fit(ROUGH, releases(2, SIMULATOR, 0, TRUTH), white_noise(), unknowns))
    assert free.untold == (Free("capstan_friction"),)
    assert free.rank == 3
    assert free.condition > 1e3
    random = np.random.default_rng(0)
    pulled = [recorded(SIMULATOR, bend, random, TRUTH, tensions=PULLS) for bend in BENDS[:2]]
    driven = identifiability(fit(ROUGH, pulled, white_noise(), unknowns))
    assert driven.untold == ()
    assert driven.rank == 4
    assert driven.condition < 1e3


def test_unknowns_that_do_the_same_are_told_by_name() -> None:
    twice = (Free("stiffness"), Free("viscous_friction"), Free("stiffness", 0), Free("stiffness", 1))
    found = identifiability(fit(ROUGH, releases(1, SIMULATOR, 0), white_noise(), twice))
    assert any({one, other} <= {twice[0], twice[2], twice[3]} for one, other, _ in found.entangled)
    assert all(twice[1] not in pair[:2] for pair in found.entangled)
    assert found.rank == 3


def test_intervals_cover_the_truth() -> None:
    """Of 45 intervals of 95 %, all but five: if they hold, more are missed once in fifty times."""
    hits = 0
    truth = np.array([value - NOMINAL[name][0] for name, value in TRUTH.items()])
    for seed in range(15):
        low, high = interval(bootstrap(fitted_releases(seed), np.random.default_rng(seed)))
        hits += int(np.sum((low <= truth) & (truth <= high)))
    assert hits >= 40


def test_an_interval_of_what_the_data_do_not_tell_is_what_was_known_before() -> None:
    """Capstan friction of 5 % tolerance in a release, where no cable pulls."""
    known = Free("capstan_friction", tolerance=0.05)
    fitted = fit(ROUGH, releases(2, SIMULATOR, 0, TRUTH), white_noise(), (*FREE, known))
    draws = bootstrap(fitted, np.random.default_rng(0))
    assert draws[:, -1].std() == pytest.approx(0.05 * NOMINAL["capstan_friction"][0], rel=0.1)


def test_draws_scatter_as_errors_do_and_around_the_answer() -> None:
    fitted = fitted_releases(0)
    draws = bootstrap(fitted, np.random.default_rng(0))
    ratio = draws.std(axis=0) / deviations(fitted)
    assert np.all((ratio >= 0.999) & (ratio < 3.0))
    middle = (draws.mean(axis=0) - fitted.space.amounts(fitted.coordinates)) / draws.std(axis=0)
    np.testing.assert_allclose(middle, 0.0, atol=0.1)
    np.testing.assert_array_equal(draws, bootstrap(fitted, np.random.default_rng(0)))
    narrow, wide = (np.diff(interval(draws, level), axis=0) for level in (0.5, 0.95))
    assert np.all(narrow < wide)


def test_models_are_drawn_from_what_the_data_leave_open() -> None:
    fitted = fitted_releases(0)
    models = list(drawn_models(fitted, np.random.default_rng(0), 400))
    values = np.array([[model.values()[name][0] for name in TRUTH] for model in models])
    np.testing.assert_allclose(values.std(axis=0), deviations(fitted), rtol=0.15)
    middle = np.array([fitted.value(free) for free in FREE])
    np.testing.assert_allclose((values.mean(axis=0) - middle) / deviations(fitted), 0.0, atol=0.2)
    again = next(drawn_models(fitted, np.random.default_rng(0), 1))
    assert again.values()["stiffness"][0] == values[0, 0]


def test_moves_without_a_stretch_are_those_of_a_fit_without_its_windows() -> None:
    """Windows are nearly linear: leave out a whole run that is one stretch, and fit the rest."""
    runs = [run.rows(slice(0, 33)) for run in releases(3, SIMULATOR, 4, TRUTH)]
    whole, rest = (fit(ROUGH, some, white_noise(), FREE) for some in (runs, runs[1:]))
    moves = moves_without(whole)
    assert moves.shape == (3, 3)
    moved = (rest.coordinates - whole.coordinates) * whole.space.scale / deviations(rest)
    predicted = moves[0] * whole.space.scale / deviations(rest)
    assert np.max(np.abs(moved)) > 0.5
    np.testing.assert_allclose(predicted, moved, atol=0.3)


def test_errors_that_hang_together_widen_the_intervals() -> None:
    """Noise that is alike over a tenth of a second, taken for white: the textbook's intervals are too narrow."""
    random, runs = np.random.default_rng(8), []
    for bend in BENDS[:2]:
        clean = recorded(SIMULATOR, bend)
        drift = np.exp(-np.abs(clean.times[:, None] - clean.times) / 0.1)
        root = np.linalg.cholesky(drift + 1e-9 * np.eye(clean.times.size))
        assert clean.theta_rate is not None
        runs.append(
            replace(
                clean,
                theta=clean.theta + ANGLE_NOISE * root @ random.normal(size=clean.theta.shape),
                theta_rate=clean.theta_rate + RATE_NOISE * root @ random.normal(size=clean.theta.shape),
            )
        )
    fitted = fit(ROUGH, runs, white_noise(), FREE)
    draws = bootstrap(fitted, np.random.default_rng(0))
    assert np.mean(draws.std(axis=0) / deviations(fitted)) > 1.2


def test_a_free_run_is_the_whole_run_from_its_first_window_alone() -> None:
    run = recorded(SIMULATOR, BENDS[0], np.random.default_rng(3))
    clean = recorded(SIMULATOR, BENDS[0])
    seen = free_run(ROUGH, run, white_noise())
    assert seen is not None
    np.testing.assert_array_equal(seen.times, run.times)
    assert np.sqrt(np.mean((seen.theta - clean.theta) ** 2)) < ANGLE_NOISE
    wrong = free_run(ROUGH.around(ROUGH.model.with_values({"stiffness": 0.8})), run, white_noise())
    assert wrong is not None
    assert np.sqrt(np.mean((wrong.theta - clean.theta) ** 2)) > 5 * ANGLE_NOISE


@pytest.mark.parametrize("bend", BENDS[:2])
def test_a_slow_cameras_free_run_begins_where_its_first_window_was_fitted(bend: tuple[float, float]) -> None:
    """The rate that the first rows show depends on how many there are; the state that was fitted does not."""
    fast, clean = (recorded(SIMULATOR, bend, random, rates=False) for random in (np.random.default_rng(3), None))
    run = fast.rows(slice(None, None, 4))  # 30 a second
    seen = free_run(ROUGH, run, white_noise(rate=None))
    assert seen is not None
    assert np.sqrt(np.mean((seen.theta - clean.theta[::4]) ** 2)) < ANGLE_NOISE / 2


def test_a_free_run_with_a_sensors_own_offset() -> None:
    simulator = small_simulator("angle_offset", TOLERANCES)
    run = recorded(simulator, BENDS[0], np.random.default_rng(3))
    off = replace(run, theta=run.theta + np.array([0.0, 0.05]))
    own = (Free("angle_offset.offset", 1, 7),)
    without, with_own = (free_run(simulator, off, white_noise(), unknowns) for unknowns in ((), own))
    assert without is not None
    assert with_own is not None
    assert np.std(with_own.theta - off.theta) < 1.3 * ANGLE_NOISE < np.std(without.theta - off.theta)


STEPS = Tensions(np.arange(0, 0.6, 1 / 30), np.random.default_rng(0).uniform(0, 8, (18, 2)))
"""Rows as a commander sends them, 30 times a second."""


@pytest.mark.parametrize("held", [True, False])
def test_how_tensions_go_on_between_rows_is_told_by_the_data(held: bool) -> None:
    truth = replace(STEPS, held=held)
    random = np.random.default_rng(2)
    driven = recorded(SIMULATOR, BENDS[0], random, tensions=truth)
    free = recorded(SIMULATOR, BENDS[1], random)
    given: list[Recording] = [replace(driven, tensions=replace(STEPS, held=not held)), free]
    found = with_likelier_rows(ROUGH, given, white_noise(), FREE)
    assert found[0].tensions is not None
    assert found[0].tensions.held is held
    assert found[1] is free
    assert with_likelier_rows(ROUGH, [free], white_noise(), FREE) == (free,)


@pytest.mark.parametrize("slope", [3.3, 4.0, 6.0])
def test_a_ramp_is_no_jump(slope: float) -> None:
    """Tensions that change fast and evenly, measured: joints do nothing at once, and half a row still tells."""
    times = np.arange(73) / 120
    up = np.clip(slope * (np.arange(73) - 6), 0, 20 * slope / 3.3)
    tensions = Tensions(times, np.stack([up, np.zeros(73)], axis=1), held=False)
    run = recorded(SIMULATOR, BENDS[0], np.random.default_rng(5), tensions=tensions)
    assert not jumps_tell([run])
    (found,) = with_likelier_rows(ROUGH, [replace(run, tensions=replace(tensions, held=True))], white_noise(), FREE)
    assert found.tensions is not None
    assert not found.tensions.held


def test_a_joint_that_slips_by_chance_beside_a_jump_tells_nothing_of_tensions() -> None:
    """A cable that is late answers later than the row; what joints do just then they have done before as well."""
    times = np.arange(12) / 120
    jolts = 60 * np.array([0, 1, -1, 1, -1, 1, -1, -1, 1, -1, 1])  # [rad/s2], before the jump and after it
    rate = np.zeros((12, 2))
    rate[1:, 0] = np.cumsum(jolts) / 120
    u = np.zeros((12, 2))
    u[:7, 0] = 9.0
    sticking = Recording("late", times, np.zeros((12, 2)), rate, Tensions(times, u))
    (found,) = with_likelier_rows(ROUGH, [sticking], white_noise(), FREE)
    assert found.tensions is not None
    assert found.tensions.held
