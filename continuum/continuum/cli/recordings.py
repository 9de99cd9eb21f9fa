"""Recordings that a command is given, with what was repaired in them printed on stderr."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from continuum.printable import printable

if TYPE_CHECKING:
    from continuum.recordings.recording import Recording


def read_recordings(paths: Sequence[str]) -> list[Recording]:
    """Read all, then print the notes of each: what was not understood may be what matters.

    Raises:
        FileError: one cannot be read.
    """
    from continuum.recordings.read_recording import read_recording  # here, so that help need not wait for rosbags

    recordings = [read_recording(path) for path in paths]
    for recording in recordings:
        for note in recording.notes:
            print(f"continuum: {printable(recording.name)}: {printable(note)}", file=sys.stderr)
    return recordings
