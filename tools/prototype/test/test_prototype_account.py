"""Simulations of a run that the model itself made."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.identification.free import Free
from continuum.identification.noise import Noise, estimate_noise
from continuum.recordings.recording import Recording
from tools.prototype.account import at_rest, compared, free, whole

MODEL = load_model("lamecc_prototype.yaml")
TIMES = np.arange(73) / 120


@pytest.fixture(scope="module")
def run() -> Recording:
    found = Simulator(MODEL).run(np.radians([12.0, 15.0, 18.0, 21.0, 24.0]), TIMES)
    return Recording("made", TIMES, found.theta, found.theta_rate)


@pytest.fixture(scope="module")
def noise(run: Recording) -> Noise:
    return estimate_noise([run])


def test_what_is_simulated_again_is_met(run: Recording, noise: Noise) -> None:
    again = free(MODEL, run, noise, "again")
    assert again.name == "again"
    assert again.position < 0.02
    assert at_rest(MODEL, run, "at rest").position < 1e-3


def test_a_stiffness_that_is_wrong_is_seen_and_refitted(run: Recording, noise: Noise) -> None:
    wrong = MODEL.with_values({"stiffness": 1.1 * float(MODEL.parameters.stiffness[0])})
    left = free(wrong, run, noise, "wrong").position
    assert left > 0.05
    assert whole(wrong, run, noise, "refitted", [Free("stiffness")]).position < left / 2


def test_a_first_state_that_suits_the_whole_run_is_found(run: Recording, noise: Noise) -> None:
    wrong = MODEL.with_values({"stiffness": 1.1 * float(MODEL.parameters.stiffness[0])})
    assert whole(wrong, run, noise, "begun elsewhere", ()).position < free(wrong, run, noise, "begun there").position


def test_what_cannot_be_simulated_is_infinitely_far(run: Recording) -> None:
    assert compared(None, replace(run, name="none"), "nothing").position == np.inf
