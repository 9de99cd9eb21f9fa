"""Exam: a real arm of two joints with torque-controlled drives (data/double_pendulum), diagnosed and predicted.

Its makers' model has no friction. Two runs are given to the diagnosis; its result predicts a third, unseen run.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

import numpy as np

from continuum.discovery import Diagnosis, diagnose
from continuum.dynamics.model import Model
from continuum.recordings.recording import Recording
from tools.benchmarks.exams.double_pendulum_csv import JOINTS, TORQUES
from tools.benchmarks.exams.pendulum_prediction import Prediction, predicted
from tools.benchmarks.exams.pendulum_runs import (
    WITHHELD,
    delayed,
    nominal,
    recordings,
    turned,
    with_half_the_last_mass,
    with_makers_friction,
)
from tools.benchmarks.exams.pendulum_torques import TorqueChoice, tried

ALTERED: Final = 1  # joint, from 0, whose readings are altered
TURN: Final = 3.0  # degrees, added to the first run
LAG: Final = 0.010  # s, in both runs
NOMINAL, MAKERS, EXTENDED = "nominal, without friction", "nominal, with its makers' friction", "extended"


@dataclass(frozen=True)
class Answers:
    """All results of the section.

    Attributes:
        first: diagnosis of the given runs by the nominal model.
        halved, offset, late: by the extended model, whose last link lacks half of its mass, and of altered readings.
        choices: choices of the torques that drive the arm.
        predictions: predictions of the unseen run, by model.
        notes: repairs while reading that run.
    """

    first: Diagnosis
    halved: Diagnosis
    offset: Diagnosis
    late: Diagnosis
    choices: tuple[TorqueChoice, ...]
    predictions: Mapping[str, Prediction]
    notes: tuple[str, ...]


def first_diagnosis() -> Diagnosis:
    """Diagnose the given runs with the model without friction."""
    return _diagnosed(recordings(), nominal())


def answers(first: Diagnosis, pool: Executor) -> Answers:
    """Compute the results that follow from the first diagnosis, the longest computation first."""
    extended, given = first.extended_model, recordings()
    shifted = [turned(run, ALTERED, np.radians(TURN)) if r == 0 else run for r, run in enumerate(given)]
    later = [delayed(run, ALTERED, LAG) for run in given]
    keys = [tuple((cause.effect, cause.joints) for cause in causes) for causes in first.sets]
    halved = pool.submit(_diagnosed, given, with_half_the_last_mass(extended))
    late = pool.submit(_diagnosed, later, extended)
    tries = [pool.submit(tried, torques, keys) for torques in itertools.product(TORQUES, repeat=len(JOINTS))]
    offset = pool.submit(_diagnosed, shifted, extended)
    models = {NOMINAL: nominal(), MAKERS: with_makers_friction(), EXTENDED: extended}
    (run,) = recordings([WITHHELD])
    predictions = {name: pool.submit(predicted, model, run) for name, model in models.items()}
    return Answers(
        first, halved.result(), offset.result(), late.result(), tuple(one.result() for one in tries),
        {name: one.result() for name, one in predictions.items()}, run.notes,
    )  # fmt: skip


def _diagnosed(runs: list[Recording], model: Model) -> Diagnosis:
    return diagnose(runs, model, with_power=False)
