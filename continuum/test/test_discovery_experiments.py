"""The next experiment: runs that are proposed separate what they are said to separate, and nothing else."""

from __future__ import annotations

from functools import cache

import numpy as np

from continuum.discovery.candidates import examine
from continuum.discovery.designs import designs
from continuum.discovery.examination import Examination, Examined
from continuum.discovery.experiments import experiments
from continuum.discovery.result import Experiment
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.recordings.recording import Recording

TIMES, NOISE = np.arange(0, 1.2, 1 / 120), np.deg2rad(0.1)


def releases(model: Model, *bends: float) -> list[Recording]:
    random, found = np.random.default_rng(2), list[Recording]()
    for bend in bends:
        moved = Simulator(model).run(np.full(5, bend / 5), TIMES)
        read = moved.theta + NOISE * random.standard_normal(moved.theta.shape)
        found.append(Recording(f"release {bend:.1f}", TIMES, read))
    return found


@cache
def examined() -> tuple[Examination, list[Recording]]:
    """A spring at joint 3 that rests 4 degrees off, or a sensor there whose zero is off in each recording."""
    model = load_model("lamecc_prototype.yaml")
    rest = model.parameters.rest_angle + np.where(np.arange(5) == 2, 0.07, 0.0)
    recordings = releases(model.with_values({"rest_angle": list(rest)}), 1.2, -0.9)
    return examine(recordings, model), recordings


def candidate(label: str) -> Examined:
    found, _ = examined()
    return next(one for one in (found.baseline, *found.others) if one.found.label == label)


def proposed(*labels: str) -> dict[str, Experiment]:
    (found, recordings), sets = examined(), [candidate(label) for label in labels]
    return {one.name: one for one in experiments(found, sets, sets[0].found.lin.library, recordings, ())}


def test_zeros_by_protractor_separate_a_sensor_from_a_spring_better_than_a_release_does() -> None:
    found = proposed("rest_angle@3", "angle_offset@3")
    by_hand, release = found["release with zeros by protractor"], found["release from the other side"]
    assert by_hand.runs == 1
    assert release.runs != 1


def test_nothing_separates_a_set_from_itself() -> None:
    for one in proposed("rest_angle@3", "rest_angle@3").values():
        assert one.separates < 0.02
        assert not one.runs


def test_one_set_needs_no_separation() -> None:
    assert all(np.isnan(one.separates) and not one.runs for one in proposed("rest_angle@3").values())


def test_runs_ask_nothing_of_an_arm_that_it_was_not_given() -> None:
    found, recordings = examined()
    bends = [abs(float(np.sum(one.theta[0]))) for one in recordings]
    for one in designs(found.problem.structure.given, recordings):
        assert abs(float(np.sum(one.posture))) <= max(*bends, np.pi / 3) + 1e-6
        assert np.all(one.inputs.values <= 100)
