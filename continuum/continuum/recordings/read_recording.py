"""One run from a file of any known kind: a CSV table, or a rosbag2 recording."""

from __future__ import annotations

from pathlib import Path

from continuum.recordings.bag import is_bag
from continuum.recordings.recording import Recording
from continuum.recordings.recording_bag import read_recording_bag
from continuum.recordings.recording_csv import read_recording_csv


def read_recording(path: str | Path) -> Recording:
    """Read the run of a CSV file, or of a rosbag2 recording's folder or storage file.

    Raises:
        FileError: it cannot be read, or is not such a recording.
    """
    return read_recording_bag(path) if is_bag(path) else read_recording_csv(path)
