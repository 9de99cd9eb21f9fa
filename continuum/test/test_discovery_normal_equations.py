"""Normal equations with eliminated unknowns against one dense least-squares problem."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from continuum_laws.strategies import LAW
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.normal_equations import NormalEquations, Scale, Values, WithoutEach, independent
from continuum.discovery.segment import Segment
from continuum.discovery.unknowns import Unknown

pytestmark = pytest.mark.slow

COMMON, LOCAL, N, ROWS, FLOOR = 4, 6, 2, 15, 0.01
RUNS, SEGMENTS, PER_RUN = 3, (1, 2, 1), (1, 0, 2)


def unknown(random: np.random.Generator, low: float = -np.inf, high: float = np.inf) -> Unknown:
    return Unknown({}, False, 0.0, float(random.normal()), float(random.uniform(0.5, 2)), low, high)


def drawn_segment(run: int, whole: np.ndarray) -> Segment:
    """Of [J r]."""
    return Segment.of(run, slice(0, len(whole) // N), np.zeros((len(whole) // N, N)), whole[:, :-1], whole[:, -1])


class Drawn:
    """Random segments of three runs, and all unknowns in one vector: common, own by run, local by segment."""

    def __init__(self, seed: int, bounded: bool = False) -> None:
        random = np.random.default_rng(seed)
        bounds = (-0.05, 0.05) if bounded else (-np.inf, np.inf)
        common = [unknown(random, *bounds) for _ in range(COMMON)]
        self.unknowns = SimpleNamespace(
            common=common, per_run=tuple([unknown(random) for _ in range(m)] for m in PER_RUN)
        )
        count = sum(SEGMENTS)
        self.values = Values(
            np.zeros(COMMON), tuple(random.normal(0, 1, m) for m in PER_RUN), tuple(random.normal(0, 1, (count, LOCAL)))
        )
        self.precision = random.uniform(0.5, 2, LOCAL) ** -2
        widths = [(r, COMMON + PER_RUN[r] + LOCAL + 1) for r in range(RUNS) for _ in range(SEGMENTS[r])]
        self.segments = [drawn_segment(r, random.normal(0, 1, (ROWS * N, width))) for r, width in widths]
        self.scale = Scale(self.segments, FLOOR)
        self.weights = self.scale.weights([one.error for one in self.segments])

    @property
    def normal(self) -> NormalEquations:
        return NormalEquations(self.unknowns, self.values, self.segments, self.weights, self.precision)  # type: ignore[arg-type]

    def columns(self, number: int) -> np.ndarray:
        """Where a segment's unknowns stand in the one vector."""
        run = self.segments[number].run
        per_run = COMMON + sum(PER_RUN[:run]) + np.arange(PER_RUN[run])
        local = COMMON + sum(PER_RUN) + number * LOCAL + np.arange(LOCAL)
        return np.concatenate([np.arange(COMMON), per_run, local]).astype(int)

    def dense(self, left_out: int | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Information and right side of everything; one segment's rows may be left out."""
        every = [*self.unknowns.common, *(one for per_run in self.unknowns.per_run for one in per_run)]
        local = np.concatenate(self.values.local)
        x = np.concatenate([self.values.common, *self.values.per_run, local])
        precision = np.concatenate([[one.sd**-2 for one in every], np.tile(self.precision, len(self.segments))])
        mean = np.concatenate([[one.mean for one in every], np.zeros(local.size)])
        A, b = np.diag(precision), -precision * (x - mean)
        for i, one in enumerate(self.segments):
            if i != left_out:
                at, w = self.columns(i), self.weights[i]
                J, r = one.jacobian, one.residuals
                A[np.ix_(at, at)] += w * J.T @ J
                b[at] -= w * J.T @ r
        return A, b


@LAW
@given(st.integers(0, 10**6))
def test_a_step_is_that_of_all_unknowns_at_once(seed: int) -> None:
    drawn = Drawn(seed)
    A, b = drawn.dense()
    step, found = np.linalg.solve(A, b), drawn.normal.stepped(0.0)
    flat = np.concatenate([found.common, *found.per_run, *found.local])
    at = np.concatenate([drawn.values.common, *drawn.values.per_run, *drawn.values.local])
    np.testing.assert_allclose(flat - at, step, rtol=1e-6, atol=1e-8)


@LAW
@given(st.integers(0, 10**6))
def test_standard_deviations_are_those_of_the_whole_information(seed: int) -> None:
    drawn = Drawn(seed)
    whole = np.linalg.inv(drawn.dense()[0])
    np.testing.assert_allclose(drawn.normal.covariance, whole[:COMMON, :COMMON], rtol=1e-6, atol=1e-10)
    per_run = np.sqrt(np.diag(whole))[COMMON : COMMON + sum(PER_RUN)]
    np.testing.assert_allclose(np.concatenate(drawn.normal.per_run_sd()), per_run, rtol=1e-6)


@LAW
@given(st.integers(0, 10**6))
def test_a_step_keeps_within_bounds(seed: int) -> None:
    assert np.all(np.abs(Drawn(seed, bounded=True).normal.stepped(1e-4).common) <= 0.05 + 1e-12)


@LAW
@given(st.integers(0, 10**6))
def test_errors_are_predicted_by_the_other_segments(seed: int) -> None:
    """The common ones and its recording's by all rows but its own, those of the segment by its own rows, at a price."""
    drawn = Drawn(seed)
    errors, shared = drawn.normal.without_each(drawn.scale).errors, COMMON + sum(PER_RUN)
    A, b = drawn.dense()
    for i, one in enumerate(drawn.segments):
        others = np.linalg.solve(*drawn.dense(left_out=i))[:shared]
        rest, known = np.arange(shared, len(b)), np.arange(shared)
        local = np.linalg.solve(A[np.ix_(rest, rest)], b[rest] - A[np.ix_(rest, known)] @ others)
        residual = one.residuals + one.jacobian @ np.concatenate([others, local])[drawn.columns(i)]
        departure = drawn.values.local[i] + local[i * LOCAL : (i + 1) * LOCAL]
        square = np.sum(residual**2) + FLOOR**2 / drawn.scale.independent * np.sum(drawn.precision * departure**2)
        np.testing.assert_allclose(errors[i], np.sqrt(square / residual.size), rtol=1e-6)


@LAW
@given(st.integers(0, 10**6))
def test_the_expected_fall_is_that_of_the_quadratic_cost(seed: int) -> None:
    drawn = Drawn(seed)
    A, b = drawn.dense()
    step = np.linalg.solve(A, b)
    fall = drawn.normal.expected_fall(drawn.normal.stepped(0.0))
    np.testing.assert_allclose(fall, 0.5 * step @ A @ step, rtol=1e-6)


@LAW
@given(st.integers(0, 10**6), st.floats(0.1, 10.0))
def test_a_cost_falls_where_its_gradient_points(seed: int, stretch: float) -> None:
    """The weight of squared residuals is the slope of the cost, above the noise and below."""
    drawn = Drawn(seed)
    one = drawn.segments[0]
    small = one.with_residuals(one.residuals * (stretch * FLOOR / one.error))
    grown = one.with_residuals(small.residuals * (1 + 1e-6))
    slope = (drawn.scale.cost(grown) - drawn.scale.cost(small)) / (0.5 * (grown.square - small.square))
    np.testing.assert_allclose(slope, drawn.scale.weights([small.error])[0], rtol=1e-3)


@pytest.mark.parametrize("rho", [-0.3, 0.0, 0.5, 0.9])
def test_correlated_rows_count_as_few_as_their_mean_implies(rho: float) -> None:
    """The mean of a series that forgets by rho a row varies as that of as many independent rows; none count twice."""
    rows = np.arange(3000)
    variance = np.sum(rho ** np.abs(rows[:, None] - rows)) / rows.size if rho > 0 else 1.0
    assert independent(2.0, 2.0 * rho) == pytest.approx(1 / variance, rel=0.01)


def left_out(seed: int, shift: float, unequal: float = 0.0) -> WithoutEach:
    """Of 16 segments in half of which a size is larger by ``shift``; they tell of it by logarithms with some spread."""
    random, count, rows = np.random.default_rng(seed), 16, 40
    sensitivities = random.normal(0, 1, (count, rows * N, COMMON + LOCAL + 1))
    sensitivities[:, :, 0] *= np.exp(unequal * random.normal(size=(count, 1)))
    sensitivities[:, :, -1] *= FLOOR
    sensitivities[count // 2 :, :, -1] -= shift * sensitivities[count // 2 :, :, 0]
    segments = [drawn_segment(0, one) for one in sensitivities]
    unknowns = SimpleNamespace(common=[unknown(random) for _ in range(COMMON)], per_run=((),))
    values = Values(np.zeros(COMMON), (np.zeros(0),), tuple(np.zeros((count, LOCAL))))
    weights = [one.readings.size / one.square for one in segments]
    return NormalEquations(unknowns, values, segments, weights, np.ones(LOCAL)).without_each(Scale(segments, FLOOR))  # type: ignore[arg-type]


@pytest.mark.parametrize("unequal", [0.0, 1.0])
def test_segments_of_a_right_model_disagree_by_chance_only(unequal: float) -> None:
    """Also where few of them tell of a size: as often as the probability says."""
    output = np.array([left_out(seed, 0.0, unequal).probability(range(COMMON)) for seed in range(400)])
    assert np.mean(output < 0.05) < 0.09
    assert left_out(0, FLOOR, unequal).probability(range(COMMON)) < 1e-3
