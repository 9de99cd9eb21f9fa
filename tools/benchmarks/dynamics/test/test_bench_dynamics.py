"""The benchmark compares integrators of one and the same Eq. 12, and judges them by the goals."""

from functools import lru_cache

import numpy as np
import pytest

from continuum.dynamics.balance import numpy_state_space
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.integration.tolerances import Tolerances
from tools.benchmarks.dynamics.lean_rates import lean_rates
from tools.benchmarks.dynamics.orders import slope_error
from tools.benchmarks.dynamics.result import Result, Score, record_of
from tools.benchmarks.dynamics.rivals import BASELINE, Rival, rivals
from tools.benchmarks.dynamics.scene import Scene, longer_arm, prototype_release

pytestmark = pytest.mark.slow


@lru_cache
def scene() -> Scene:
    return prototype_release(0.2)


@lru_cache
def all_rivals() -> tuple[Rival, ...]:
    return tuple(rivals(scene()))


@pytest.mark.parametrize("n", [1, 5, 8])
def test_the_baselines_rates_are_those_of_the_library(n: int) -> None:
    model, random = longer_arm(n, 0.1).model, np.random.default_rng(n)
    lean, whole = lean_rates(model.parameters), numpy_state_space(model)
    for _ in range(5):
        x = random.uniform(-1, 1, 2 * n)
        np.testing.assert_allclose(lean(0.0, x), whole(x, np.zeros(2)), rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(CompiledEquations(model).rates(x, np.zeros(2)), lean(0.0, x), rtol=1e-8, atol=1e-8)


def test_every_rival_finds_the_converged_solution() -> None:
    """At the thesis's tolerances, within the 0.05 degrees that the fast path is granted."""
    exact = scene().converged()
    assert all_rivals()[0].name == BASELINE
    assert len(all_rivals()) >= 5
    for rival in all_rivals():
        error = np.degrees(np.abs(rival.run() - exact).max())
        assert 1e-6 < error < 0.05, rival.name


def test_sensitivities_come_to_those_of_neighbouring_runs() -> None:
    assert slope_error(scene(), Tolerances(1e-6, 1e-7, 0.01)) < 1e-3


@pytest.mark.parametrize(
    ("seconds", "error", "met"), [(0.02, 0.05, [True, True]), (0.021, 0.05, [False, True]), (0.02, 0.06, [True, False])]
)
def test_speed_and_nearness_have_a_goal_each(seconds: float, error: float, met: list[bool]) -> None:
    scores = [Score(BASELINE, 1.0, 0.03, None), Score("ESDIRK3", seconds, error, None)]
    assert [figure.is_met for figure in record_of(Result(scores, [], [], {})).figures] == met


def test_the_rival_is_the_fastest_of_others() -> None:
    names = {BASELINE: 1.0, "slow": 2.0, "fast": 0.5, "ESDIRK4": 0.1, "ESDIRK3": 0.1}
    scores = [Score(name, seconds, 0.01, None) for name, seconds in names.items()]
    figure, *_ = record_of(Result(scores, [], [], {})).figures
    assert (figure.rival, figure.rival_value, figure.value) == ("fast", 2.0, 10.0)
