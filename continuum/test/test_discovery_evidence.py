"""Evidence by linear algebra against integrals over the coefficients."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
import scipy.special
import scipy.stats
from continuum_laws.strategies import LAW
from drawn_evidence import WIDTH, Drawn, hypothesis, log_integral, without
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.evidence import Evidence

SEEDS = st.integers(0, 10**6)


@LAW
@given(SEEDS)
def test_evidence_is_the_integral_over_all_coefficients(seed: int) -> None:
    """Of the hypothesis and the nuisances; levels are alike beforehand."""
    drawn = Drawn.by(seed)
    evidence = drawn.evidence(drawn.pair)
    expected = [log_integral(*without(*drawn.quadratic(k, [drawn.pair]), [0]), np.full(3, -np.inf)) for k in (0, 1)]
    np.testing.assert_allclose(evidence.by_level((drawn.pair,)), expected, rtol=1e-6)
    np.testing.assert_allclose(evidence.total((drawn.pair,)), scipy.special.logsumexp(expected) - np.log(2), rtol=1e-6)
    assert evidence.best_level((drawn.pair,)) == int(np.argmax(expected))
    alone = [log_integral(*drawn.quadratic(k, []), np.full(2, -np.inf)) for k in (0, 1)]
    np.testing.assert_allclose(evidence.by_level(()), alone, rtol=1e-6)


@LAW
@given(SEEDS, st.floats(-3, 3))
def test_a_bound_cuts_likelihood_and_prior_alike(seed: int, bound: float) -> None:
    """Evidence is that of a prior above the bound; likely or far from what the data say."""
    drawn = Drawn.by(seed)
    cut = replace(drawn.pair, least=np.array([bound * drawn.pair.sd[0], -np.inf]))
    A, b, c = without(*drawn.quadratic(0, [cut]), [0, 1, 3])
    expected = log_integral(A, b, c, cut.least[:1]) - scipy.stats.norm.logsf(bound)
    np.testing.assert_allclose(drawn.evidence(cut).by_level((cut,))[0], expected, atol=0.02)


@LAW
@given(SEEDS, st.floats(-2, 2), st.floats(-2, 2))
def test_bounds_count_by_each_coefficient_s_own_distribution(seed: int, one: float, other: float) -> None:
    """Which is all that there is to them where they are not correlated."""
    drawn = Drawn.by(seed)
    A, b, c = without(*drawn.quadratic(0, [drawn.pair]), [0, 1])
    least = np.array([one, other]) * drawn.pair.sd
    cut = replace(drawn.pair, least=least)
    expected = log_integral(A, b, c, np.full(2, -np.inf))
    for k in (0, 1):
        single = without(A, b, c, [1 - k])
        expected += log_integral(*single, least[k : k + 1]) - log_integral(*single, np.full(1, -np.inf))
    expected -= np.sum(scipy.stats.norm.logsf([one, other]))
    np.testing.assert_allclose(drawn.evidence(cut).by_level((cut,))[0], expected, atol=0.04)


@LAW
@given(SEEDS)
def test_what_each_run_has_for_itself_is_integrated_run_by_run(seed: int) -> None:
    """By quadrature over the coefficients of all runs, nuisances in closed form; alone and with another effect."""
    drawn = Drawn.by(seed)
    evidence = drawn.evidence(drawn.per_run, drawn.pair)
    for chosen, rest in (((drawn.per_run,), [0, 1]), ((drawn.pair, drawn.per_run), [0, 1, 2, 3])):
        expected = [log_integral(*without(*drawn.quadratic(k, chosen), rest), np.full(3, -np.inf)) for k in (0, 1)]
        np.testing.assert_allclose(evidence.by_level(chosen), expected, rtol=1e-6)


@LAW
@given(SEEDS, st.floats(0, 5))
def test_ranked_sets_are_the_best_of_all(seed: int, price: float) -> None:
    """By evidence with constraints, less a price for every effect."""
    drawn, random = Drawn.by(seed), np.random.default_rng(seed)
    nuisance = replace(drawn.nuisance, constraints=random.normal(0, 1, (2, WIDTH)), least=random.normal(0, 1, 2))
    singles = [
        hypothesis([(column,)], random.uniform(0.3, 2, 1), np.array([least]))
        for column, least in zip((0, 2, 3, 5), (0.0, -0.3, -np.inf, -np.inf), strict=True)
    ]
    sets = [(), *((one,) for one in singles), *combinations(singles, 2)]
    evidence = Evidence(drawn.runs, nuisance, singles, WIDTH, 2)
    worth = sorted((evidence.total(s, with_constraints=True) - price * len(s) for s in sets), reverse=True)
    found = evidence.ranked(sets, price, 3)
    np.testing.assert_allclose([value for value, _ in found[:3]], worth[:3], rtol=1e-9)
    for value, chosen in found:
        assert value == pytest.approx(evidence.total(chosen, with_constraints=True) - price * len(chosen))
