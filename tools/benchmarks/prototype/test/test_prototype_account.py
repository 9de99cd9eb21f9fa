"""The end of a run that the model itself made is predicted; the same diagnosis in a process says the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from continuum.discovery import Diagnosis, diagnose
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.recordings.recording import Recording
from continuum.recordings.recording_csv import read_recording_csv
from tools.benchmarks.prototype.account import end_predicted
from tools.benchmarks.prototype.stability import repeated, said

pytestmark = pytest.mark.slow

MODEL = load_model("lamecc_prototype.yaml")
TIMES = np.arange(97) / 120


def written(folder: Path, theta: np.ndarray) -> Path:
    head = ",".join(["t_s", *(f"q{joint}_deg" for joint in range(1, 6))])
    np.savetxt(folder / "run.csv", np.column_stack([TIMES, np.degrees(theta)]), "%.9f", ",", header=head, comments="")
    return folder / "run.csv"


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    theta = Simulator(MODEL).run(np.radians([12.0, 15.0, 18.0, 21.0, 24.0]), TIMES).theta
    noise = np.radians(0.02) * np.random.default_rng(1).standard_normal(theta.shape)
    return written(tmp_path_factory.mktemp("run"), theta + noise)


@pytest.fixture(scope="module")
def run(path: Path) -> Recording:
    return read_recording_csv(path)


@pytest.fixture(scope="module")
def result(run: Recording) -> Diagnosis:
    return diagnose([run], MODEL)


def test_the_end_of_what_the_model_made_is_predicted(run: Recording) -> None:
    _, predicted = end_predicted(run, 58, MODEL)
    assert [(one.model, one.begins) for one in predicted] == [
        (model, begins) for model in ("refitted", "extended") for begins in ("smoothed", "measured")
    ]
    for one in predicted:
        assert np.max(one.degrees) < 1.0


def test_a_process_with_another_kernel_says_the_same(path: Path, result: Diagnosis) -> None:
    here, there = said(result), repeated(path, "HASWELL", 0.0, 0.0, 0)
    assert (there.kind, there.effects) == (here.kind, here.effects)
