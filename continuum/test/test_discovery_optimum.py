"""Most probable coefficients within bounds and constraints against a general minimiser."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.optimize
from continuum_laws.strategies import LAW
from drawn_evidence import NUISANCES, WIDTH, Drawn
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.evidence import Evidence
from continuum.discovery.quadratic_program import bounded_minimum

SEEDS = st.integers(0, 10**6)


@LAW
@given(SEEDS)
def test_the_optimum_is_that_of_all_coefficients_at_once(seed: int) -> None:
    """Each run's own among them; their spread is the inverse of the whole information's."""
    drawn, chosen = Drawn.by(seed), (Drawn.by(seed).pair, Drawn.by(seed).per_run)
    A, b, _ = drawn.quadratic(1, chosen)
    best, expected = drawn.evidence(*chosen).optimum(chosen, 1), np.linalg.solve(A, b)
    np.testing.assert_allclose(best.theta[NUISANCES], expected[:2], rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(best.values, expected[2:4], rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(best.local.ravel(), expected[4:], rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(best.covariance, np.linalg.inv(A)[2:4, 2:4], rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(best.sd**2, np.diag(best.covariance), rtol=1e-9)
    assert best.local_columns.tolist() == [3]
    assert abs(best.rise) < 1e-9


def least_of_all(A: np.ndarray, b: np.ndarray, G: np.ndarray, least: np.ndarray) -> np.ndarray:
    """The same minimum by sequential least squares."""
    scale = np.linalg.cholesky(A).T
    found = scipy.optimize.minimize(
        lambda z: 0.5 * z @ z - np.linalg.solve(scale.T, b) @ z, np.zeros(b.size),
        jac=lambda z: z - np.linalg.solve(scale.T, b), method="SLSQP",
        constraints={"type": "ineq", "fun": lambda z: G @ np.linalg.solve(scale, z) - least,
                     "jac": lambda z: np.linalg.solve(scale.T, G.T).T},
        options={"maxiter": 500, "ftol": 1e-14},
    )  # fmt: skip
    return np.linalg.solve(scale, found.x)


def convex(seed: int, variables: int, rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """A problem that has a solution: some point is within all constraints."""
    random = np.random.default_rng(seed)
    factor, G = random.normal(0, 1, (variables + 2, variables)), random.normal(0, 1, (rows, variables))
    A, b = factor.T @ factor + 0.1 * np.eye(variables), random.normal(0, 3, variables)
    return A, b, G, G @ random.normal(0, 1, variables) - random.exponential(1, rows)


def assert_solved(A: np.ndarray, b: np.ndarray, G: np.ndarray, least: np.ndarray) -> None:
    """The constraints hold, nothing is lower, and the rise is that from the free minimum."""
    x, rise = bounded_minimum(A, b, G, least)
    expected = least_of_all(A, b, G, least)
    np.testing.assert_array_less(-1e-7, G @ x - least)
    np.testing.assert_allclose(x, expected, rtol=1e-4, atol=1e-4)
    free = np.linalg.solve(A, b)
    lifted = 0.5 * x @ A @ x - b @ x - (0.5 * free @ A @ free - b @ free)
    np.testing.assert_allclose(rise, lifted, rtol=1e-6, atol=1e-8)


@LAW
@given(SEEDS)
def test_constraints_lower_evidence_by_their_rise(seed: int) -> None:
    """By as much as the least of minus the log-posterior within them is higher; not where they hold anyway."""
    drawn, random = Drawn.by(seed), np.random.default_rng(seed)
    G, least = random.normal(0, 1, (2, WIDTH)), random.normal(0, 0.3, 2)
    G[:, 3] = 0.0
    nuisance = replace(drawn.nuisance, constraints=G, least=least, most=np.array([np.inf, 0.4 * drawn.nuisance.sd[1]]))
    chosen = (drawn.pair,)
    evidence = Evidence(drawn.runs[:1], nuisance, chosen, WIDTH, 2)
    A, b, _ = drawn.quadratic(0, chosen)
    H = np.hstack([np.eye(WIDTH)[:, NUISANCES], drawn.pair.map(WIDTH)])
    second = np.array([[0, 1.0, 0, 0], [0, -1.0, 0, 0]])
    rows, values = np.concatenate([G @ H, second]), np.append(least, -nuisance.most[1] * np.ones(2))
    free, bounded = np.linalg.solve(A, b), least_of_all(A, b, rows, values)
    rise = 0.5 * (bounded - free) @ A @ (bounded - free)
    found = evidence.by_level(chosen)[0] - evidence.by_level(chosen, with_constraints=True)[0]
    np.testing.assert_allclose(found, rise, rtol=1e-4, atol=1e-4)
    best = evidence.optimum(chosen, 0)
    np.testing.assert_allclose(np.append(best.theta[NUISANCES], best.values), bounded, rtol=1e-3, atol=1e-3)


@LAW
@given(SEEDS)
def test_the_optimum_keeps_the_set_s_own_bounds(seed: int) -> None:
    drawn = Drawn.by(seed)
    free = drawn.evidence(drawn.pair).optimum((drawn.pair,), 0).values
    cut = replace(drawn.pair, least=free + np.array([0.2, -0.2]) * drawn.pair.sd)
    found = drawn.evidence(cut).optimum((cut,), 0)
    A, b, _ = drawn.quadratic(0, (cut,))
    expected = least_of_all(A, b, np.eye(4)[2:], cut.least)
    np.testing.assert_allclose(found.values, expected[2:], rtol=1e-3, atol=1e-4)
    assert drawn.evidence(cut).optimum((cut,), 0, run_bounds=False).values == pytest.approx(free)


@LAW
@given(SEEDS, st.integers(1, 8), st.data())
def test_the_bounded_minimum_is_the_least_within_any_constraints(
    seed: int, variables: int, data: st.DataObject
) -> None:
    """Also where there are more than can be independent."""
    assert_solved(*convex(seed, variables, data.draw(st.integers(0, 3 * variables + 2))))
