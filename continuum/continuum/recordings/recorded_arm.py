"""Whether a recording is of the given arm: both have the same sections with the same numbers of joints."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from continuum.arm import Arm
from continuum.errors import FileError
from continuum.joint_names import bending_joints


def check_joints(path: Path | str, names: Iterable[str], arm: Arm) -> None:
    """Refuse a recording of another arm.

    Args:
        path: path of the recording.
        names: names of all of its joints; those of no section do not count.
        arm: the expected arm.

    Raises:
        FileError: it is of another arm; the message names the sections of both.
    """
    recorded, expected = bending_joints(names), {section.name: section.n_joints for section in arm.sections}
    if recorded != expected:
        raise FileError(path, f"is of another arm: it has {_words(recorded)}; the arm file {_words(expected)}")


def _words(joints: Mapping[str, int]) -> str:
    """Format as `section_1 (5 joints), section_2 (1 joint)`."""
    return (
        ", ".join(f"{name} ({n} joint{'' if n == 1 else 's'})" for name, n in sorted(joints.items()))
        or "no section's joints"
    )
