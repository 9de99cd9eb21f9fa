"""Identification of five parameters from four of eight releases, and validation on the other four."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from continuum.discovery.parameter_fit import fit_parameters
from continuum.dynamics.model_file import load_model
from continuum.identification.identified import Identified
from continuum.identification.scores import scores
from continuum.identification.thesis_swarm import swarm_parameters
from continuum.recordings.recording import Recording
from tools.benchmarks.identification.arms import IDENTIFY, MeasuredArm

MODEL = "lamecc_prototype.yaml"


@dataclass(frozen=True)
class Answer:
    """Result of one method.

    Attributes:
        errors: relative error of each parameter.
        held: whether the 95 % interval of each parameter contains the truth; None without intervals.
        position: mean NRMSE of the angles in the validation runs.
        seconds: processor time with compiled equations [s].
    """

    errors: tuple[float, ...]
    held: tuple[bool, ...] | None
    position: float
    seconds: float


def by_fit(arm: MeasuredArm) -> Answer:
    """Maximum likelihood of open-loop simulations: `continuum identify`."""
    return _answer(arm, lambda runs: fit_parameters(runs, load_model(MODEL)))


def by_swarm(arm: MeasuredArm, seed: int) -> Answer:
    """Table 2 of the thesis: `continuum identify --method swarm`."""
    return _answer(arm, lambda runs: swarm_parameters(runs, load_model(MODEL), seed))


def _answer(arm: MeasuredArm, identify: Callable[[Sequence[Recording]], Identified]) -> Answer:
    began = time.process_time()
    identified = identify([arm.runs[k - 1] for k in IDENTIFY])
    seconds = time.process_time() - began
    kept = [run for k, run in enumerate(arm.runs, start=1) if k not in IDENTIFY]
    position = float(np.mean([score.position for score in scores(identified.model, kept)]))
    values = identified.values
    errors = tuple(one.value / arm.truth[one.name] - 1 for one in values)
    known = all(np.isfinite(one.low) for one in values)
    held = tuple(one.low <= arm.truth[one.name] <= one.high for one in values) if known else None
    return Answer(errors, held, position, seconds)
