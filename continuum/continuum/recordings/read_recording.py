"""One run from a file of any known kind: a CSV table, or a rosbag2 recording."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from continuum.dynamics.model import Model
from continuum.recordings.bag import is_bag
from continuum.recordings.recording import Recording
from continuum.recordings.recording_bag import read_recording_bag
from continuum.recordings.recording_csv import read_recording_csv


def read_recording(
    path: str | Path, model: Model | None = None, joints: Sequence[str] = (), topic: str | None = None
) -> Recording:
    """Read the run of a CSV file, or of a rosbag2 recording's folder or storage file.

    Args:
        path: path of the file.
        model: model of the arm, which may know the names of its joints in messages, and whether they turn round.
        joints: names of the joints in a rosbag2 recording, from base to tip, instead of those of the model.
        topic: topic of the joints in a rosbag2 recording, instead of /joint_states.

    Raises:
        FileError: it cannot be read, or is not such a recording.
    """
    return read_recording_bag(path, model, joints, topic) if is_bag(path) else read_recording_csv(path, model)
