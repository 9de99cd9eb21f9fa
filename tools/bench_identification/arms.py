"""Arms whose truth is known, and four release tests of each: the plant of the blind tests, with nothing hidden."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from blind.plant import make_case, write_case

from continuum.recordings.recording import Recording
from continuum.recordings.recording_csv import read_recording_csv

_NAMES = {
    "stiffness": "stiffness",
    "viscous_friction": "viscous",
    "coulomb_friction": "coulomb",
    "stribeck_gain": "stribeck",
    "stribeck_speed": "stribeck_rate",
}
"""Of the thesis's five parameters, and what the plant calls them."""


@dataclass(frozen=True)
class MeasuredArm:
    """Runs of an arm.

    Attributes:
        runs: what was measured.
        truth: the thesis's five parameters, means over the joints, by name.
    """

    runs: tuple[Recording, ...]
    truth: Mapping[str, float]


def measured_arm(seed: int) -> MeasuredArm:
    """Four releases of 1.6 s, rates measured, sensors' noise as usual."""
    case = make_case(dataset=("release",) * 4, seed=seed)
    with TemporaryDirectory() as folder:
        runs = tuple(read_recording_csv(file) for file in write_case(case, Path(folder)))
    parameters = case.truth.parameters
    truth = {name: float(np.mean(getattr(parameters, theirs))) for name, theirs in _NAMES.items()}
    return MeasuredArm(runs, truth)


@contextmanager
def eight_releases(seed: int) -> Iterator[list[Path]]:
    """Files of eight releases of 1.6 s of an arm with friction at one joint that the model does not have."""
    case = make_case(("joint_friction",), dataset="eight_releases", seed=seed)
    with TemporaryDirectory() as folder:
        yield write_case(case, Path(folder))
