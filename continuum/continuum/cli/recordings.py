"""The recordings of a command: options on their joints and topics, reading, and notes about repairs on stderr."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from continuum.errors import InvalidValueError
from continuum.languages import ENGLISH, Translator
from continuum.printable import printable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from continuum.dynamics.model import Model
    from continuum.recordings.recording import Recording


def add_recordings(parser: Any) -> None:
    """Add the recordings, and the options that say what to read from a rosbag2 recording."""
    parser.add_argument(
        "data", metavar="RECORDING", nargs="+", help="recordings: CSV files (t_s,q1_deg,..) or rosbag2 folders"
    )
    add_bag_options(parser)


def add_bag_options(parser: Any) -> None:
    """Add ``--joints`` and ``--topic``."""
    parser.add_argument(
        "--joints", metavar="NAME,NAME,..",
        help="names of the joints in rosbag2 recordings, from base to tip; default: those in the model file, or those "
        "of the nodes of this workspace",
    )  # fmt: skip
    parser.add_argument(
        "--topic", metavar="/TOPIC",
        help="topic of the joint states in rosbag2 recordings; tensions are read from cable_states beside it; default "
        "/joint_states",
    )  # fmt: skip


def read_recordings(options: argparse.Namespace, model: Model, tr: Translator = ENGLISH) -> list[Recording]:
    """Read all recordings, then print the notes of each, including unknown content, which may matter.

    Raises:
        FileError: a recording cannot be read.
        InvalidValueError: joints or a topic that no recording can have.
    """
    from continuum.recordings.read_recording import read_recording  # imported here because rosbags is slow to load

    joints = named_joints(options, options.data, model)
    recordings = [read_recording(path, model, joints, options.topic) for path in options.data]
    for recording in recordings:
        for note in recording.notes:
            print(f"continuum: {printable(recording.name)}: {printable(tr(note))}", file=sys.stderr)
    return recordings


def named_joints(options: argparse.Namespace, paths: Sequence[str], model: Model | None) -> list[str]:
    """Return the names of ``--joints``; none without it.

    Raises:
        InvalidValueError: not one name for each joint of the model, or no rosbag2 recording for ``--joints`` or
            ``--topic``.
    """
    from continuum.dynamics.model import check_names
    from continuum.recordings.bag import is_bag

    for option, text in (("--joints", options.joints), ("--topic", options.topic)):
        if text is not None and not any(map(is_bag, paths)):
            allowed = "left out: only rosbag2 recordings have names; the columns of a table are q1_deg .. from the base"
            raise InvalidValueError(option, text, allowed)
    if options.joints is None:
        return []
    names = [name.strip() for name in options.joints.split(",")]
    check_names(names, len(names) if model is None else model.n_joints, "--joints")
    return names


def bag_words(options: argparse.Namespace) -> list[str]:
    """Return ``--joints`` and ``--topic`` as given, for a command line."""
    given = (("--joints", options.joints), ("--topic", options.topic))
    return [word for option, text in given if text is not None for word in (option, text)]
