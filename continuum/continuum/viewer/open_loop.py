"""Open-loop simulation of a recording by a model, drawn over the measured motion."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.model import Model
from continuum.errors import InvalidValueError
from continuum.identification.scores import scores
from continuum.joint_names import bending_joints, phi_joint, theta_joints
from continuum.recordings.recording import Recording
from continuum.viewer.tracks import Track


def open_loop_track(recording: Recording, measured: Track, model: Model, name: str, origin: float = 0.0) -> Track:
    """Return the joint angles [rad] that the sensors of a model would read, simulated from start to end of a run.

    Only the initial angles and rates are fitted to the run. The bending plane of the section is that of the first
    sample.

    Args:
        recording: the run, with its inputs.
        measured: measured joint angles of one section by name [rad].
        model: model of the section.
        name: name of the model in messages.
        origin: time at which the measured angles begin, as the recording counts it [s]; damaged samples that are left
            out may make the recording begin later.

    Raises:
        InvalidValueError: the arm has several sections, or the model has another number of joints or other inputs, or
            its simulation fails.
    """
    sections = sorted(bending_joints(measured.names))
    if len(sections) != 1:
        raise InvalidValueError(f"sections of {recording.name}", sections, f"one, as {name} has")
    (section,) = sections
    (score,) = scores(model, [recording])
    if not np.isfinite(score.theta).all():
        raise InvalidValueError(
            f"open-loop simulation of {recording.name} by {name}", "failed", "a model whose motion stays finite"
        )
    phi = phi_joint(section)
    plane = np.full((recording.times.size, 1), measured.at(float(measured.times[0])).get(phi, 0.0))
    names = (*theta_joints(section, recording.n_joints), phi)
    return Track(recording.times - origin, names, np.hstack([score.theta, plane]))


def hangs(model: Model) -> bool:
    """Return whether gravity pulls the straight arm away from its base."""
    pull = model.parameters.gravity * np.cos(model.parameters.hang_angle)
    return bool(np.all(pull > 0.0))
