"""Screening by open-loop sensitivities: what is hidden promises most; where nothing is, nothing is worth it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from continuum.discovery.baseline import fitted_baseline, problem_of
from continuum.discovery.decision import is_worth
from continuum.discovery.output_error import OutputError
from continuum.discovery.problem import linearise
from continuum.discovery.score_test import Promise, promises
from continuum.discovery.search import Found
from continuum.dynamics.dry_friction import with_dry_friction
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.estimation.structure import Structure, absent_values
from continuum.recordings.recording import Recording

NOISE, TIMES = 1e-3, np.arange(0, 1.0, 1 / 120)
BENDS = np.radians([[14.0, 10, 12, 9, 8], [-12.0, -9, -14, -10, -6], [16.0, -8, 10, -9, 8], [5.0, 12, -9, 14, -10]])


@lru_cache
def promised(effect: str, parameter: str, value: float, joint: int) -> list[Promise]:
    """What every effect promises of releases of an arm with one effect at one joint."""
    model = with_dry_friction(load_model("lamecc_prototype.yaml"))
    hidden = effect_named(effect)
    values: Mapping[str, np.ndarray] = absent_values(hidden, 5)
    values[parameter][joint] += value
    simulator = Simulator(replace(model, effects=(ActiveEffect(hidden, values),)))
    random, recordings = np.random.default_rng(1), list[Recording]()
    for i, bend in enumerate(BENDS):
        q = simulator.run(bend, TIMES).theta
        recordings.append(Recording(f"run_{i}", TIMES, q + NOISE * random.standard_normal(q.shape)))
    problem, state = fitted_baseline(problem_of(Structure(model, with_tension=False), recordings))
    found, judge = Found(linearise(problem, state), ()), OutputError(problem, recordings)
    fit = judge.fit(found, [])
    return promises(judge, fit, found.lin.library)


@pytest.mark.parametrize(
    ("effect", "parameter", "value", "joint"),
    [("joint_stiffness", "excess", 0.4, 1), ("rest_angle", "angle", 0.08, 3)],
)
def test_what_is_hidden_promises_most(effect: str, parameter: str, value: float, joint: int) -> None:
    ranked = promised(effect, parameter, value, joint)
    best = next(one for one in ranked if one.hypothesis.effect == effect)
    assert best.hypothesis.joints == (joint,)
    assert is_worth(best.gain, best.observations)
    assert best.gain > 0.6 * ranked[0].gain


def test_where_nothing_is_hidden_nothing_is_worth_it() -> None:
    best = promised("joint_stiffness", "excess", 0.0, 0)[0]
    assert not is_worth(best.gain, best.observations)
