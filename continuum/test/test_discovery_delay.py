"""Readings that are late, given in the model or sought; inputs that are half a row off where misunderstood."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from continuum.discovery.baseline import fitted_baseline, problem_of
from continuum.discovery.candidates import examine
from continuum.discovery.open_loop import RunSimulation, Simulators
from continuum.discovery.problem import State
from continuum.discovery.unknowns import Unknown
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect, Model, with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording

DELAY, TIMES, ROWS = 0.03, np.arange(0, 0.8, 1 / 120), slice(0, 60)
PLACE = ("sensor_delay", "delay", -1)


def nominal() -> Model:
    return with_dry_friction(load_model("lamecc_prototype.yaml"))


def pull(times: np.ndarray) -> np.ndarray:
    return np.stack([5 * (1 - np.cos(9 * np.maximum(times, 0))), np.zeros(times.size)], axis=1)


@pytest.fixture(scope="module")
def recording() -> Recording:
    moved = Simulator(nominal()).run(np.zeros(5), TIMES, Tensions(TIMES, pull(TIMES - DELAY)))
    noise = np.random.default_rng(0).standard_normal((2, TIMES.size, 5)) * np.array([1e-3, 1e-2])[:, None, None]
    return Recording("pull", TIMES, moved.theta + noise[0], moved.theta_rate + noise[1], Tensions(TIMES, pull(TIMES)))


def simulation(recording: Recording, model: Model, searched: float | None) -> tuple[Simulators, State]:
    problem = problem_of(Structure(model, ["sensor_delay"]), [recording])
    state = fitted_baseline(problem)
    active = {} if searched is None else {"sensor_delay": {"delay": np.array([searched])}}
    return Simulators(problem, (recording,)), replace(state, active=active)


def test_a_given_delay_is_a_delay_that_was_sought(recording: Recording) -> None:
    """And with it the recording is simulated."""
    late = {"delay": np.array([DELAY]), "lag": np.zeros(5)}
    given = replace(nominal(), effects=(ActiveEffect(effect_named("sensor_delay"), late),))
    simulators, state = simulation(recording, given, None)
    angles = RunSimulation(simulators, state, 0).readings(ROWS, np.zeros(15))
    other, _ = simulation(recording, nominal(), None)
    searched = replace(state, active={"sensor_delay": {"delay": np.array([DELAY])}})
    again = RunSimulation(other, searched, 0).readings(ROWS, np.zeros(15))
    np.testing.assert_allclose(again, angles, atol=1e-9)
    assert np.sqrt(np.mean((angles - recording.theta[ROWS]) ** 2)) < 0.01


def test_the_derivative_by_a_delay_is_a_difference(recording: Recording) -> None:
    """At the tolerances with which fits simulate."""
    simulators, state = simulation(recording, nominal(), DELAY)
    unknown = Unknown({PLACE: 1.0}, True, np.log(DELAY), np.log(DELAY), 1.0, -10.0, 0.0)
    slope = RunSimulation(simulators, state, 0, [unknown]).segment(ROWS, np.zeros(15)).jacobian[:, 0]
    ends = []
    for sign in (-1, 1):
        moved = replace(state, active={"sensor_delay": {"delay": np.array([DELAY * np.exp(0.05 * sign)])}})
        ends.append(RunSimulation(simulators, moved, 0).readings(ROWS, np.zeros(15)).ravel())
    difference = (ends[1] - ends[0]) / 0.1
    assert np.linalg.norm(slope - difference) < 0.1 * np.linalg.norm(difference)


@pytest.mark.parametrize("held", [True, False])
def test_inputs_that_hold_are_reported_from_those_that_change_linearly(held: bool) -> None:
    """At 60 rows a second either taken for the other is 8 ms early or late."""
    times = np.arange(0, 0.8, 1 / 60)
    tensions = Tensions(times, pull(times), held=held)
    moved = Simulator(nominal()).run(np.zeros(5), times, tensions)
    noise = np.random.default_rng(0).standard_normal((2, times.size, 5)) * np.array([1e-3, 1e-2])[:, None, None]
    seen = Recording("pull", times, moved.theta + noise[0], moved.theta_rate + noise[1], Tensions(times, pull(times)))
    found = examine([seen], nominal(), effects=[])
    assert [run.held for run in found.problem.runs] == [held]
