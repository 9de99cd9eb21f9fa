"""Recordings and models of the double pendulum (data/double_pendulum), and their alterations in the exam."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np

from continuum.dynamics.model import Model, with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.recordings.recording import Recording
from continuum.recordings.recording_csv import read_recording_csv
from tools.benchmarks.exams.double_pendulum_csv import convert

DATA: Final = Path("data/double_pendulum")
GIVEN: Final = ("run_00", "run_02")
WITHHELD: Final = "run_12"
MAKERS_FRICTION: Final = (0.16, 0.12)  # N m at each joint, Coulomb, as its makers identified it
MEASURED: Final = ("measured", "measured")


def recordings(names: Sequence[str] = GIVEN, torques: Sequence[str] = MEASURED) -> list[Recording]:
    """Return runs as `diagnose` reads them, with the named torque of each joint."""
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / f"{name}.csv" for name in names]
        for file in files:
            convert(DATA / file.name, file, torques)
        return [read_recording_csv(file) for file in files]


def nominal() -> Model:
    """Return the model with its makers' values, without friction."""
    return load_model("double_pendulum.yaml")


def with_makers_friction() -> Model:
    """Return the nominal model with the dry Coulomb friction that its makers identified elsewhere."""
    return with_dry_friction(nominal().with_values({"coulomb_friction": list(MAKERS_FRICTION)}))


def folded(model: Model) -> Model:
    """Return an equivalent model in which effects that only change parameters are replaced by changed parameters."""
    p = model.parameters
    kept = tuple(a for a in model.effects if a.effect.change_parameters(p, a.values) is p)
    return replace(model, parameters=model.changed_parameters, effects=kept)


def with_half_the_last_mass(model: Model) -> Model:
    """Return the folded model with half of the last link's mass; its inertia, with the rotor, is unchanged."""
    whole = folded(model)
    mass = np.array(whole.parameters.mass, dtype=float)
    mass[-1] /= 2
    return whole.with_values({"mass": mass.tolist()})


def turned(run: Recording, joint: int, angle: float) -> Recording:
    """Return the run with an angle [rad] added to the readings of a joint, counted from 0."""
    theta = run.theta.copy()
    theta[:, joint] += angle
    return replace(run, theta=theta)


def delayed(run: Recording, joint: int, lag: float) -> Recording:
    """Return the run with the angle of a joint, from 0, delayed by ``lag`` [s], linear between rows; rates stay."""
    theta = run.theta.copy()
    theta[:, joint] = np.interp(run.times - lag, run.times, theta[:, joint])
    return replace(run, theta=theta)
