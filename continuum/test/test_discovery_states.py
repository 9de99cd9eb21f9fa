"""Effects with states amid a recording: what they are at a segment's beginning, and derivatives by all unknowns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from continuum.discovery.baseline import fitted_baseline, problem_of
from continuum.discovery.open_loop import RunSimulation, Simulators
from continuum.discovery.problem import State
from continuum.discovery.unknowns import Unknown, shifted
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import ActiveEffect, with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.estimation.run import Trajectory
from continuum.estimation.structure import Structure, absent_values
from continuum.recordings.recording import Recording

pytestmark = pytest.mark.slow

FINE, TIMES = Tolerances(1e-8, 1e-9, 0.01), np.arange(0, 0.9, 1 / 120)
ROWS = slice(54, 70)
SPRING = "joint_stiffness"


def simulations(name: str, values: Mapping[str, float]) -> tuple[Simulators, State, np.ndarray]:
    """A pulled arm with an effect, its exact motion as the smoothed one, and all states, (n_times, n_x)."""
    model, effect = with_dry_friction(load_model("lamecc_prototype.yaml")), effect_named(name)
    per_run = {n: np.array(v) for n, v in absent_values(effect, 5).items()}
    per_run |= {n: np.full_like(per_run[n], value) for n, value in values.items()}
    pull = np.stack([8 * (1 - np.cos(5 * TIMES)), np.zeros(TIMES.size)], axis=1)
    arm, inputs = replace(model, effects=(ActiveEffect(effect, per_run),)), Tensions(TIMES, pull, held=True)
    bent = np.full(5, 0.1)
    begin = effect.initial_state(bent, pull[0], per_run, arm.parameters)
    moved = Simulator(arm, FINE).run(np.concatenate([bent, np.zeros(5), begin]), TIMES, inputs)
    seen = Recording("pull", TIMES, moved.theta, moved.theta_rate, Tensions(TIMES, pull))
    problem = problem_of(Structure(model, [name, SPRING]), [seen])
    way = Trajectory(moved.theta, moved.theta_rate, 0 * moved.theta, 0 * moved.theta)
    state = replace(fitted_baseline(problem), shared={(SPRING, "excess", 1): 0.0}, active={name: per_run}, ways=(way,))
    return Simulators(problem, (seen,), FINE), state, moved.states


CASES = [
    ("actuator_lag", {"lag": 0.1}),
    ("base_compliance", {"compliance": 0.01, "frequency": 60.0, "damping": 0.1}),
    ("elastic_cable", {"lag": 0.03, "stiffness": 400.0}),
]


@pytest.mark.parametrize(("name", "values"), CASES)
def test_states_amid_a_recording_are_those_of_its_whole_simulation(name: str, values: Mapping[str, float]) -> None:
    simulators, state, states = simulations(name, values)
    begin, _ = RunSimulation(simulators, state, 0)._beginning(ROWS.start, np.zeros(15))
    scale = np.maximum(np.max(np.abs(states[:, 10:]), axis=0), 1e-6)
    np.testing.assert_allclose((begin[10:] - states[ROWS.start, 10:]) / scale, 0, atol=0.01)


@pytest.mark.parametrize(("name", "values"), CASES)
def test_derivatives_of_states_amid_a_recording_are_differences(name: str, values: Mapping[str, float]) -> None:
    """By an effect's values, on which its states depend, and by a spring, on which the arm's posture does."""
    simulators, state, _ = simulations(name, values)
    unknowns = [Unknown({(SPRING, "excess", 1): 1.0}, False, 0.0, 0.0, 1.0, -1.0, 20.0)]
    for parameter in values:
        value = np.log(float(state.active[name][parameter][0]))
        unknowns.append(Unknown({(name, parameter, -1): 1.0}, True, value, value, 1.0, -20.0, 20.0))
    for unknown in unknowns:
        for row in (0, ROWS.start):
            slope = RunSimulation(simulators, state, 0, [unknown])._beginning(row, np.zeros(15))[1][10:, 0]
            ends = [
                RunSimulation(simulators, shifted(state, unknown, 0, step), 0)._beginning(row, np.zeros(15))[0][10:]
                for step in (-1e-3, 1e-3)
            ]
            difference = (ends[1] - ends[0]) / 2e-3
            error = np.linalg.norm(slope - difference)
            assert error < 0.01 * np.linalg.norm(difference) + 1e-6, (list(unknown.places), row)
