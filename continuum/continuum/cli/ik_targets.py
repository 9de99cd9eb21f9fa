"""Targets of the tip as they come from the command line or from a file."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from continuum.arrays import Array
from continuum.errors import FileError, InvalidValueError
from continuum.kinematics.ik_target import Target, Targets
from continuum.number_checks import finite_of_shape

_COLUMNS = "lines of 3 (x y z), 6 (and a direction) or 7 numbers (and a quaternion x y z w), all alike"


def target_of(position: list[float], options: argparse.Namespace) -> Target:
    """The one target of the command line.

    Raises:
        InvalidValueError: it is malformed, or has a direction and a quaternion.
    """
    if options.quaternion and options.direction:
        raise InvalidValueError("--direction", options.direction, "none beside --quaternion, which has it already")
    rotation = _rotations("--quaternion", [options.quaternion])[0] if options.quaternion else None
    return Target(position, options.direction, rotation)


def read_targets(path: str) -> Targets:
    """Targets of a text file; commas and what follows a # count as blanks, a heading may come before the numbers.

    Raises:
        FileError: it cannot be read, has no targets, or a line, which is named, holds none.
    """
    try:
        lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(path, f"cannot be read ({error})") from error
    words = {k: line.partition("#")[0].replace(",", " ").split() for k, line in enumerate(lines, start=1)}
    written = [(k, row) for k, row in words.items() if row]
    if written and _is_heading(written[0][1]):
        written = written[1:]
    if not written:
        raise FileError(path, f"holds no targets; wanted are {_COLUMNS}")
    width = len(written[0][1])
    rows = np.array([_numbers(path, k, row, width) for k, row in written])
    for (k, _), row in zip(written, rows[:, 3:], strict=True):
        if row.size and not np.any(row):
            raise FileError(path, f"line {k}: a {'quaternion' if width == 7 else 'direction'} of nothing but zeros")
    if width == 7:
        return Targets(rows[:, :3], rotations=_rotations("quaternion", rows[:, 3:]))
    return Targets(rows[:, :3], rows[:, 3:] if width == 6 else None)


def _is_heading(words: list[str]) -> bool:
    """Whether a line names the columns, x, y and z first: in metres, as ``x`` or ``x_m``."""
    return [word.lower().removesuffix("_m") for word in words[:3]] == ["x", "y", "z"]


def _numbers(path: str, k: int, words: list[str], width: int) -> list[float]:
    """The ``width`` numbers of line ``k``."""
    if len(words) != width or width not in (3, 6, 7):
        raise FileError(path, f"line {k} has {len(words)} columns; wanted are {_COLUMNS}")
    numbers = []
    for word in words:
        try:
            numbers.append(float(word))
        except ValueError:
            raise FileError(path, f"line {k}: {word!r} is no number; a heading begins with x y z") from None
        if not math.isfinite(numbers[-1]):
            raise FileError(path, f"line {k}: {word!r}; allowed: a finite number")
    return numbers


def _rotations(name: str, quaternions: object) -> Array:
    values = finite_of_shape(name, quaternions, (-1, 4))
    lengths = np.linalg.norm(values, axis=1)
    if not np.all((lengths > 1e-9) & (lengths < 1e9)):
        raise InvalidValueError(name, values[np.argmin(lengths)].tolist(), "four numbers, not all zero")
    rotations: Array = Rotation.from_quat(values).as_matrix()
    return rotations
