"""Screening by open-loop sensitivities: what is hidden promises most; where nothing is, nothing is worth it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from continuum.discovery.baseline import fitted_baseline, problem_of
from continuum.discovery.decision import is_worth
from continuum.discovery.fit_result import Fitted
from continuum.discovery.output_error import OutputError
from continuum.discovery.power import powers
from continuum.discovery.problem import linearise
from continuum.discovery.score_test import promises
from continuum.discovery.search import RUNNER_UP, Found
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect, with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.estimation.structure import Structure, absent_values
from continuum.recordings.recording import Recording

pytestmark = pytest.mark.slow

NOISE, TIMES = 1e-3, np.arange(0, 1.0, 1 / 120)
BENDS = np.radians([[14.0, 10, 12, 9, 8], [-12.0, -9, -14, -10, -6], [16.0, -8, 10, -9, 8], [5.0, 12, -9, 14, -10]])


@lru_cache
def fitted(effect: str, parameter: str, value: float, joint: int) -> tuple[OutputError, Found, Fitted]:
    """The baseline, fitted to releases of an arm with one effect at one joint."""
    model = with_dry_friction(load_model("lamecc_prototype.yaml"))
    hidden = effect_named(effect)
    values: Mapping[str, np.ndarray] = absent_values(hidden, 5)
    values[parameter][joint] += value
    simulator = Simulator(replace(model, effects=(ActiveEffect(hidden, values),)))
    random, recordings = np.random.default_rng(1), list[Recording]()
    for i, bend in enumerate(BENDS):
        q = simulator.run(bend, TIMES).theta
        recordings.append(Recording(f"run_{i}", TIMES, q + NOISE * random.standard_normal(q.shape)))
    problem = problem_of(Structure(model, with_tension=False), recordings)
    state = fitted_baseline(problem)
    found, judge = Found(linearise(problem, state), ()), OutputError(problem, recordings)
    return judge, found, judge.fit(found, [])


def test_what_is_hidden_promises_most() -> None:
    judge, found, fit = fitted("joint_stiffness", "excess", 0.4, 1)
    best = promises(judge, fit, found.lin.library)[0]
    assert best.hypothesis.key == ("joint_stiffness", (1,))
    assert is_worth(best.gain, best.observations)


def test_what_is_hidden_promises_as_much_as_what_is_like_it() -> None:
    """Sensors at a joint that are off do nearly as a spring that rests elsewhere, and are found first."""
    judge, found, fit = fitted("rest_angle", "angle", 0.08, 3)
    offset = next(h for h in found.lin.library.hypotheses if h.key == ("angle_offset", (3,)) and h.local)
    near = judge.fit(Found(found.lin, (offset,)), [fit])
    ranked = promises(judge, near, found.lin.library, offset)
    hidden = next(one for one in ranked if one.hypothesis.key == ("rest_angle", (3,)))
    assert hidden.gain > (RUNNER_UP - 1) * np.log(fit.error / near.error)
    itself = next(one for one in ranked if one.hypothesis is offset)
    np.testing.assert_allclose(itself.gain, 0, atol=0.05)


def test_where_nothing_is_hidden_nothing_is_worth_it() -> None:
    judge, found, fit = fitted("joint_stiffness", "excess", 0.0, 0)
    best = promises(judge, fit, found.lin.library)[0]
    assert not is_worth(best.gain, best.observations)


@pytest.mark.parametrize("times_smallest", [0.3, 3.0])
@pytest.mark.parametrize(
    ("effect", "parameter", "joint"), [("joint_stiffness", "excess", 1), ("tip_payload", "mass", 0)]
)
def test_what_is_larger_than_the_smallest_that_would_have_shown_is_worth_it(
    effect: str, parameter: str, joint: int, times_smallest: float
) -> None:
    """The smallest size by an arm without any effect, the gain by arms that have it."""
    judge, found, fit = fitted("joint_stiffness", "excess", 0.0, 0)
    key = effect, (joint,) if effect_named(effect).parameters[parameter].per_joint else None
    smallest = next(one for one in powers(judge, fit, found.lin.library) if one.hypothesis.key == key).smallest * (
        effect_named(effect).parameters[parameter].typical or 1.0
    )
    judge, found, fit = fitted(effect, parameter, times_smallest * smallest, joint)
    hidden = next(one for one in promises(judge, fit, found.lin.library) if one.hypothesis.key == key)
    assert is_worth(hidden.gain, hidden.observations) == (times_smallest > 1)
