"""Open-loop fits: derivatives against differences, and what was simulated is found again."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.baseline import fitted_baseline, problem_of
from continuum.discovery.fit_result import Fitted
from continuum.discovery.open_loop import RunSimulation, Simulators
from continuum.discovery.output_error import OutputError
from continuum.discovery.problem import Linearised, linearise, point_of
from continuum.discovery.search import Found
from continuum.discovery.segment import Segment, cut
from continuum.discovery.unknowns import Unknowns
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import Model, with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording

pytestmark = pytest.mark.slow

FINE = Tolerances(1e-7, 1e-8, 0.01)  # near rest, friction makes a simulation jump within coarser ones
NOISE, TIMES = 1e-3, np.arange(0, 1.0, 1 / 120)
BENDS = np.radians([[14.0, 10, 12, 9, 8], [-12.0, -9, -14, -10, -6], [16.0, -8, 10, -9, 8]])


@lru_cache
def recordings() -> tuple[Recording, ...]:
    """Releases of an arm that is stiffer and rubs more than its model says."""
    nominal = with_dry_friction(load_model("lamecc_prototype.yaml"))
    p = nominal.parameters
    arm = nominal.with_values(
        {"stiffness": 1.1 * float(p.stiffness[0]), "viscous_friction": 1.3 * float(p.viscous_friction[0])}
    )
    random, simulator = np.random.default_rng(1), Simulator(arm)
    runs = [simulator.run(bend, TIMES).theta for bend in BENDS]
    return tuple(Recording(f"run_{i}", TIMES, q + NOISE * random.standard_normal(q.shape)) for i, q in enumerate(runs))


def nominal() -> Model:
    return with_dry_friction(load_model("lamecc_prototype.yaml"))


@lru_cache
def smoothed() -> Linearised:
    problem = problem_of(Structure(nominal(), ["angle_offset"], False), recordings())
    state = fitted_baseline(problem)
    return linearise(problem, state)


@lru_cache
def fitted(effect: str = "") -> Fitted:
    lin = smoothed()
    chosen = tuple(h for h in lin.library.hypotheses if h.effect == effect and h.local and h.joints == (1,))
    return OutputError(lin.problem, recordings()).fit(Found(lin, chosen), [])


def test_derivatives_are_differences_of_simulations() -> None:
    """By values that all recordings share, by a recording's own, and by a segment's beginning and zeros."""
    lin = smoothed()
    (offset,) = (h for h in lin.library.hypotheses if h.local and h.joints == (2,))
    unknowns = Unknowns(lin.problem, Found(lin, (offset,)), {})
    simulators, rows = Simulators(lin.problem, recordings(), FINE), slice(0, 40)
    n, k = lin.problem.structure.n, len(unknowns.common)
    common = np.array([one.start for one in unknowns.common])
    per_run = tuple(np.array([0.01]) for _ in recordings())

    def segment(x: np.ndarray) -> Segment:
        state = unknowns.state(x[:k], (per_run[0] + x[k : k + 1], *per_run[1:]))
        return RunSimulation(simulators, state, 0, [*unknowns.common, *unknowns.per_run[0]]).segment(rows, x[k + 1 :])

    x = np.concatenate([common, np.zeros(1 + 3 * n)])
    jacobian = segment(x).jacobian
    sd = np.array([one.sd for one in (*unknowns.common, *unknowns.per_run[0])])
    for i, size in enumerate(np.concatenate([sd, np.full(3 * n, 0.1)])):
        step = 1e-3 * size * np.eye(x.size)[i]
        difference = (segment(x + step).residuals - segment(x - step).residuals) / (2e-3 * size)
        error = np.linalg.norm(jacobian[:, i] - difference)
        assert error < 0.05 * np.linalg.norm(difference) + 1e-6, (i, error, np.linalg.norm(difference))


def test_what_was_simulated_is_found_again() -> None:
    """Within some percent, as friction and springs share a motion; what is left is noise."""
    fit = fitted()
    p, slots = point_of(smoothed().problem, fit.state).values, smoothed().problem.structure.slots
    for name, factor in (("stiffness", 1.1), ("viscous_friction", 1.3)):
        truth = factor * float(np.mean(nominal().values()[name]))
        assert np.mean(p[slots[name]]) == pytest.approx(truth, rel=0.05)
    assert np.mean(fit.errors) == pytest.approx(NOISE, rel=0.2)


def test_an_effect_that_is_not_there_is_found_to_be_nothing() -> None:
    fit = fitted("angle_offset")
    sizes = np.concatenate(fit.values.per_run) / np.concatenate(fit.per_run_sd)
    assert sizes.size == len(recordings())
    assert np.all(np.abs(sizes) < 4)


def test_whole_recordings_begin_where_the_first_segment_does() -> None:
    judge = OutputError(smoothed().problem, recordings())
    for angles, run in zip(judge.whole(fitted()).angles, recordings(), strict=True):
        assert angles.shape == run.theta.shape
        assert np.sqrt(np.mean((angles[:20] - run.theta[:20]) ** 2)) < 3 * NOISE


@given(st.lists(st.floats(0.001, 0.4), min_size=8, max_size=200))
def test_segments_cover_all_rows_once_with_two_or_more_each(intervals: list[float]) -> None:
    times = np.cumsum(intervals)
    segments = cut(times, 0.5)
    rows = [i for one in segments for i in range(one.start, one.stop)]
    assert min(one.stop - one.start for one in segments) >= 2
    assert rows == list(range(times.size))
