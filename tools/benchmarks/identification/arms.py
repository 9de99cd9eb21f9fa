"""Arms with known parameters, and eight release tests of each: the plant of the blind tests, without hidden effects."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from blind.mujoco_plant import make_case, write_case

from continuum.recordings.recording import Recording
from continuum.recordings.recording_csv import read_recording_csv

IDENTIFY = (1, 2, 5, 8)
"""The thesis's repetitions for identification (Table 4); the others are for validation."""
_NAMES = {
    "stiffness": "stiffness",
    "viscous_friction": "viscous",
    "coulomb_friction": "coulomb",
    "stribeck_gain": "stribeck",
    "stribeck_speed": "stribeck_rate",
}
"""Names of the thesis's five parameters in the plant."""


@dataclass(frozen=True)
class MeasuredArm:
    """Runs of an arm.

    Attributes:
        runs: measured runs.
        truth: the thesis's five parameters, means over the joints, by name.
    """

    runs: tuple[Recording, ...]
    truth: Mapping[str, float]


def measured_arm(seed: int) -> MeasuredArm:
    """Eight releases of 1.6 s with the sensors' usual noise."""
    case = make_case(dataset="eight_releases", seed=seed)
    with TemporaryDirectory() as folder:
        runs = tuple(read_recording_csv(file) for file in write_case(case, Path(folder)))
    parameters = case.truth.parameters
    truth = {name: float(np.mean(getattr(parameters, theirs))) for name, theirs in _NAMES.items()}
    return MeasuredArm(runs, truth)
