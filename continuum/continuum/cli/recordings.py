"""Read the recordings of a command, and print notes about repairs on stderr."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from continuum.languages import ENGLISH, Translator
from continuum.printable import printable

if TYPE_CHECKING:
    from continuum.recordings.recording import Recording


def read_recordings(paths: Sequence[str], tr: Translator = ENGLISH) -> list[Recording]:
    """Read all recordings, then print the notes of each, including unknown content, which may matter.

    Raises:
        FileError: a recording cannot be read.
    """
    from continuum.recordings.read_recording import read_recording  # imported here because rosbags is slow to load

    recordings = [read_recording(path) for path in paths]
    for recording in recordings:
        for note in recording.notes:
            print(f"continuum: {printable(recording.name)}: {printable(tr(note))}", file=sys.stderr)
    return recordings
