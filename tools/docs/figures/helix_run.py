"""The helix of thesis 4.1 without ROS: the data of `make demo`, from the same library and parameter files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from continuum.arm import load_arm
from continuum.kinematics.routing import tangle, tangle_rates
from continuum.kinematics.tracking import Tracker
from continuum.parameter_file import flattened, read_parameter_file
from continuum.recordings.arm_recording import ArmRecording, Stream
from trajectory_generator.from_parameters import trajectory_from_mapping

ROOT = Path(__file__).resolve().parents[3]
ARM = ROOT / "continuum_description" / "config" / "three_sections.yaml"
HELIX = ROOT / "trajectory_generator" / "config" / "helix.yaml"


def helix_run() -> ArmRecording:
    """Let the arm follow the trajectory at its rate, and return the recording that the nodes would produce.

    Raises:
        ContinuumError: a file is invalid.
    """
    arm, parameters = load_arm(ARM), flattened(read_parameter_file(HELIX))
    trajectory = trajectory_from_mapping(parameters)
    times = trajectory.times(parameters["rate"])
    sample, tracker = trajectory.sample(times), Tracker(arm)
    steps = [None, *np.diff(times)]
    answers = [
        tracker.pose(position, velocity=velocity, dt=dt)
        for position, velocity, dt in zip(sample.position, sample.linear_velocity, steps, strict=True)
    ]
    w, w_rate = (np.stack(parts) for parts in zip(*((a.result.configuration, a.rate) for a in answers), strict=True))
    stamps = np.round(1e9 * times).astype(np.int64)
    return ArmRecording(
        arm=arm,
        targets=Stream(stamps, sample.position),
        status=Stream(stamps, np.array([[float(a.result.status), a.result.distance] for a in answers])),
        configurations=Stream(stamps, w),
        lengths=Stream(stamps, tangle(w, arm)),
        rates=Stream(stamps, tangle_rates(w, w_rate, arm)),
        arrivals={"/traj_pose": stamps},
    )
