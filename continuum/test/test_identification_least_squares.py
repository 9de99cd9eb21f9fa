"""The arrow-shaped least squares beside dense ones, on random linear problems and where windows are bad."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from continuum.identification.arrow_least_squares import (
    MOST_MISFIT,
    FitStatus,
    Part,
    Solution,
    Unknowns,
    _bounded_step,
    arrow_least_squares,
    misfit_of,
    reduced,
    shared_information,
    weight_of,
)

SHARED, OWN, ERRORS, WINDOWS = 4, 2, 400, 12
NEAR = 0.5
"""Standard deviations; the search ends where it can gain no more than about one of log-likelihood."""


@dataclass(frozen=True)
class Problem:
    """Windows whose errors are linear in the unknowns: e = e0 + A x + B y."""

    begin: Sequence[np.ndarray]
    by_shared: Sequence[np.ndarray]
    by_own: Sequence[np.ndarray]
    spread: np.ndarray
    own_spread: np.ndarray

    def evaluate(
        self, shared: np.ndarray, own: Sequence[np.ndarray], _anew: bool
    ) -> tuple[list[Part], list[np.ndarray]] | None:
        parts = [
            Part(e0 + a @ shared + b @ mine, a, b)
            for e0, a, b, mine in zip(self.begin, self.by_shared, self.by_own, own, strict=True)
        ]
        return parts, list(own)

    def unknowns(self, bound: float = np.inf) -> Unknowns:
        return Unknowns(
            np.zeros(SHARED), self.spread, np.full(SHARED, -bound), np.full(SHARED, bound),
            [np.zeros(OWN) for _ in self.begin], [self.own_spread for _ in self.begin],
        )  # fmt: skip

    def dense(self) -> tuple[np.ndarray, np.ndarray]:
        """All windows and priors as one system, matrix and right side."""
        size = SHARED + OWN * len(self.begin)
        rows = []
        for i, (a, b) in enumerate(zip(self.by_shared, self.by_own, strict=True)):
            row = np.zeros((a.shape[0], size))
            row[:, :SHARED], row[:, SHARED + OWN * i : SHARED + OWN * (i + 1)] = a, b
            rows.append(row)
        priors = np.diag(1 / np.concatenate([self.spread, np.tile(self.own_spread, len(self.begin))]))
        return np.vstack([*rows, priors]), -np.concatenate([*self.begin, np.zeros(size)])

    def solved(self, bound: float = np.inf) -> Solution:
        return arrow_least_squares(self.evaluate, self.unknowns(bound), 30)

    def deviation(self) -> np.ndarray:
        """Standard deviation of the shared unknowns, (SHARED,)."""
        matrix, _ = self.dense()
        return np.sqrt(np.diag(np.linalg.inv(matrix.T @ matrix)))[:SHARED]


def problem(seed: int) -> Problem:
    """Unit noise around a truth, spreads that hold some unknowns and leave others."""
    random = np.random.default_rng(seed)
    by_shared = [random.normal(size=(ERRORS, SHARED)) / 5 for _ in range(WINDOWS)]
    by_own = [random.normal(size=(ERRORS, OWN)) / 5 for _ in range(WINDOWS)]
    truth = random.normal(size=SHARED)
    begin = [
        random.normal(size=ERRORS) + a @ truth + b @ random.normal(size=OWN)
        for a, b in zip(by_shared, by_own, strict=True)
    ]
    return Problem(begin, by_shared, by_own, random.uniform(0.05, 3, SHARED), random.uniform(0.05, 3, OWN))


@pytest.mark.parametrize("seed", range(8))
def test_where_errors_are_noise_it_is_ridge_regression(seed: int) -> None:
    one = problem(seed)
    found = one.solved()
    exact = np.linalg.lstsq(*one.dense())[0]
    assert found.status is FitStatus.CONVERGED
    np.testing.assert_array_less(np.abs(found.shared - exact[:SHARED]), NEAR * one.deviation())
    np.testing.assert_allclose(np.concatenate(list(found.own)), exact[SHARED:], atol=0.05)


@pytest.mark.parametrize("seed", range(8))
def test_bounds_hold_and_the_rest_makes_the_best_of_it(seed: int) -> None:
    one = problem(seed)
    matrix, right = one.dense()
    bounds = np.full(matrix.shape[1], np.inf)
    bounds[:SHARED] = 0.3
    exact = lsq_linear(matrix, right, (-bounds, bounds)).x[:SHARED]
    found = one.solved(0.3)
    assert np.any(np.abs(exact) > 0.299)
    assert np.all(np.abs(found.shared) <= 0.3)
    np.testing.assert_array_less(np.abs(found.shared - exact), NEAR * one.deviation() + 1e-6)


@pytest.mark.parametrize("seed", range(8))
def test_a_few_bad_windows_hardly_move_the_answer(seed: int) -> None:
    one, random = problem(seed), np.random.default_rng(100 + seed)
    knock = 20 * one.by_shared[0] @ random.normal(size=SHARED) + 30 * random.normal(size=ERRORS)
    bad = replace(one, begin=[one.begin[0] + knock, *one.begin[1:]])
    # without the window, a twelfth of what is known goes
    moved = (bad.solved().shared - one.solved().shared) / one.deviation()
    plain = (np.linalg.lstsq(*bad.dense())[0] - np.linalg.lstsq(*one.dense())[0])[:SHARED] / one.deviation()
    assert np.max(np.abs(moved)) < 1.0
    assert np.max(np.abs(plain)) > 5.0


def test_the_cost_is_the_one_that_is_stated_and_least_where_the_search_ends() -> None:
    one = problem(1)
    found = one.solved()

    def cost(shared: np.ndarray, own: Sequence[np.ndarray]) -> float:
        parts, _ = one.evaluate(shared, own, False) or ([], [])
        priors = np.sum((shared / one.spread) ** 2) + sum(np.sum((mine / one.own_spread) ** 2) for mine in own)
        return float(sum(map(misfit_of, parts)) + priors) / 2

    assert found.cost == pytest.approx(cost(found.shared, found.own), rel=1e-12)
    for step in np.vstack([np.eye(SHARED), -np.eye(SHARED)]) * one.deviation():
        assert cost(found.shared + step, found.own) > found.cost + 0.2
    for step in (0.3, -0.3):
        assert cost(found.shared, [mine + step for mine in found.own]) > found.cost


def test_the_start_does_not_decide() -> None:
    one = problem(2)
    far = replace(one.unknowns(), shared=np.full(SHARED, 20.0), own=[np.full(OWN, -9.0) for _ in one.begin])
    found = arrow_least_squares(one.evaluate, far, 50)
    np.testing.assert_allclose(np.concatenate(list(found.own)), np.concatenate(list(one.solved().own)), atol=0.05)
    np.testing.assert_array_less(np.abs(found.shared - one.solved().shared), NEAR * one.deviation())


def test_information_is_that_of_the_dense_system_with_the_own_unknowns_eliminated() -> None:
    one = problem(3)
    matrix, _ = one.dense()
    full = matrix.T @ matrix
    schur = full[:SHARED, :SHARED] - full[:SHARED, SHARED:] @ np.linalg.solve(
        full[SHARED:, SHARED:], full[SHARED:, :SHARED]
    )
    found = one.solved()
    np.testing.assert_allclose(shared_information(one.unknowns(), found.parts), schur, rtol=0.1, atol=1.0)


def test_what_own_unknowns_can_make_good_is_no_slope_of_the_shared_ones() -> None:
    random = np.random.default_rng(4)
    by_own = random.normal(size=(50, OWN))
    part = Part(np.zeros(50), by_own @ random.normal(size=(OWN, SHARED)), by_own)
    assert np.max(np.abs(reduced(part, np.full(OWN, 1e6)))) < 1e-6
    np.testing.assert_allclose(reduced(part, np.full(OWN, 1e-6)), part.by_shared, rtol=1e-6)


@pytest.mark.parametrize("size", [0.1, 1.0, 3.0, 30.0])
def test_the_weight_is_the_slope_of_the_misfit(size: float) -> None:
    errors = size * np.random.default_rng(0).normal(size=60)

    def misfit(square: float) -> float:
        return misfit_of(Part(errors * np.sqrt(square / (errors @ errors)), np.zeros((60, 0)), np.zeros((60, 0))))

    s = float(errors @ errors)
    slope = (misfit(s * (1 + 1e-5)) - misfit(s * (1 - 1e-5))) / (2e-5 * s)
    assert weight_of(Part(errors, np.zeros((60, 0)), np.zeros((60, 0)))) == pytest.approx(slope, rel=1e-6)


def test_a_window_in_which_nothing_fits_counts_like_a_few_others() -> None:
    awful = Part(40 * np.ones(50), np.zeros((50, 0)), np.zeros((50, 0)))
    assert 0.7 * MOST_MISFIT < misfit_of(awful) / awful.errors.size < MOST_MISFIT
    assert weight_of(awful) < 1e-3


def test_noise_has_the_weight_one() -> None:
    assert weight_of(Part(np.ones(10), np.zeros((10, 0)), np.zeros((10, 0)))) == 1.0


def test_a_model_that_cannot_be_simulated_at_the_start() -> None:
    one = problem(5)
    found = arrow_least_squares(lambda *_: None, one.unknowns(), 30)
    assert found.status is FitStatus.NO_SIMULATION
    assert (found.cost, found.evaluations, list(found.parts)) == (np.inf, 1, [])


def test_where_the_model_cannot_be_simulated_on_the_way_it_goes_around() -> None:
    one = problem(6)
    goal = one.solved().shared
    walls = 0

    def evaluate(
        shared: np.ndarray, own: Sequence[np.ndarray], anew: bool
    ) -> tuple[list[Part], list[np.ndarray]] | None:
        nonlocal walls
        if np.linalg.norm(shared) > 0.5 * np.linalg.norm(goal) and walls < 3:
            walls += 1
            return None
        return one.evaluate(shared, own, anew)

    found = arrow_least_squares(evaluate, one.unknowns(), 30)
    assert walls == 3
    np.testing.assert_array_less(np.abs(found.shared - goal), NEAR * one.deviation())


def test_too_few_iterations_are_told() -> None:
    one = problem(7)
    far = replace(one.unknowns(), shared=np.full(SHARED, 20.0))
    assert arrow_least_squares(one.evaluate, far, 1).status is FitStatus.NO_CONVERGENCE


def test_bad_windows_are_sought_anew_where_the_search_settles() -> None:
    """One window sits in a wrong place from which no slope leads away, unless it is sought."""
    one = problem(0)
    sought = 0

    def evaluate(
        shared: np.ndarray, own: Sequence[np.ndarray], anew: bool
    ) -> tuple[list[Part], list[np.ndarray]] | None:
        nonlocal sought
        sought += anew
        parts, own = one.evaluate(shared, own, anew) or ([], [])
        if not sought:
            parts[0] = Part(np.full(ERRORS, 4.0), 0 * parts[0].by_shared, 0 * parts[0].by_own)
        return parts, own

    found = arrow_least_squares(evaluate, one.unknowns(), 30)
    assert sought >= 1
    np.testing.assert_array_less(np.abs(found.shared - one.solved().shared), NEAR * one.deviation())


@pytest.mark.parametrize("seed", range(20))
def test_a_step_solves_its_equations_but_where_a_bound_holds_it(seed: int) -> None:
    random = np.random.default_rng(seed)
    root, right = random.normal(size=(6, 6)), random.normal(size=6)
    matrix, free = root @ root.T + np.eye(6), random.random(6) < 0.8
    step = _bounded_step(matrix, right, free, np.full(6, -0.1), np.full(6, 0.1))
    inside = free & (np.abs(step) < 0.1)
    assert np.all(np.abs(step) <= 0.1)
    assert not np.any(step[~free])
    np.testing.assert_allclose((matrix @ step)[inside], right[inside], atol=1e-12)
