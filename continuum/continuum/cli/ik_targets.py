"""Targets of the tip from the command line or from a file."""

from __future__ import annotations

import argparse
import math
import re
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from continuum.arrays import Array
from continuum.errors import FileError, InvalidValueError
from continuum.kinematics.ik_target import Target, Targets
from continuum.number_checks import finite_of_shape
from continuum.recordings.csv_layout import is_number, number_of
from continuum.recordings.table_file import read_text

_DECIMAL_COMMA = re.compile(r"[+-]?\d*,?\d+([eE][+-]?\d+)?")
_BROKEN = re.compile(r"[+-]?\d+,\d+")
_CUT = re.compile(r"0\d+")  # digits after a decimal comma
_POSITION, _DIRECTION, _QUATERNION = ("x", "y", "z"), ("dx", "dy", "dz"), ("qx", "qy", "qz", "qw")
_COLUMNS = "lines of 3 (x y z), 6 (and a direction) or 7 numbers (and a quaternion x y z w), all alike"


def target_of(position: list[float], options: argparse.Namespace) -> Target:
    """Return the target of the command line.

    Raises:
        InvalidValueError: the target is malformed, or has both a direction and a quaternion.
    """
    if options.quaternion and options.direction:
        raise InvalidValueError("--direction", options.direction, "none with --quaternion, which sets it too")
    rotation = _rotations("--quaternion", [options.quaternion])[0] if options.quaternion else None
    return Target(position, options.direction, rotation)


def read_targets(path: str) -> Targets:
    """Return the targets of a text file: numbers separated by blanks, commas, semicolons or tabs; # starts a comment.

    A heading may name the columns, in any order: `_POSITION`, then `_DIRECTION` or `_QUATERNION`.

    Raises:
        FileError: the file cannot be read or has no targets, or a line, named in the message, is not a target.
    """
    lines = read_text(Path(path)).splitlines()
    for k, line in enumerate(lines, start=1):
        cells = line.partition("#")[0].split()
        if "," in line and not set(";\t") & set(line) and any(map(_CUT.fullmatch, line.split(","))):
            raise FileError(path, f"line {k}: decimal commas between commas? Put semicolons between numbers")
        if len(cells) > 1 and all(_BROKEN.fullmatch(cell) for cell in cells):
            raise FileError(
                path, f"line {k}: decimal commas between blanks? Write 0.1, or put semicolons between numbers"
            )
    words = {k: _words(line.partition("#")[0]) for k, line in enumerate(lines, start=1)}
    written = [(k, row) for k, row in words.items() if row and not row[0].startswith("sep=")]
    if written and not is_number(written[0][1][0]):
        (k, heading), *written = written
        order = _order(path, k, heading)
        for k, row in written:
            if len(row) != len(heading):
                raise FileError(path, f"line {k} has {len(row)} columns, the heading {len(heading)}")
        written = [(k, [row[i] for i in order]) for k, row in written]
    if not written:
        raise FileError(path, f"contains no targets; expected are {_COLUMNS}")
    width = len(written[0][1])
    rows = np.array([_numbers(path, k, row, width) for k, row in written])
    for (k, _), row in zip(written, rows[:, 3:], strict=True):
        if row.size and not np.any(row):
            raise FileError(path, f"line {k}: a {'quaternion' if width == 7 else 'direction'} of nothing but zeros")
    if width == 7:
        return Targets(rows[:, :3], rotations=_rotations("quaternion", rows[:, 3:]))
    return Targets(rows[:, :3], rows[:, 3:] if width == 6 else None)


def _words(line: str) -> list[str]:
    """Split a line into cells; if semicolons, or tabs without blanks or commas, separate them, commas are decimal.

    An empty cell counts, unless it is the last of its line.
    """
    line = line.replace('"', "").rstrip(" \t,;")
    for separator in ";\t":
        cells = [cell.strip() for cell in line.strip().split(separator)]
        if len(cells) > 1 and all(_DECIMAL_COMMA.fullmatch(cell) for cell in cells):
            return [cell.replace(",", ".") for cell in cells]
    return [word for part in re.split("[,;]", line) for word in part.split() or [""]] if line.strip() else []


def _order(path: str, k: int, heading: list[str]) -> list[int]:
    """Return the positions of the columns that a heading names; lengths are in metres, as ``x`` or ``x_m``."""
    names = [word.lower().removesuffix("_m") for word in heading]
    for wanted in (_POSITION, (*_POSITION, *_DIRECTION), (*_POSITION, *_QUATERNION)):
        if sorted(names) == sorted(wanted):
            return [names.index(name) for name in wanted]
    allowed = f"{' '.join(_POSITION)}, and {' '.join(_DIRECTION)} or {' '.join(_QUATERNION)}"
    raise FileError(
        path, f"line {k} names the columns {' '.join(heading)}; allowed: {allowed}, in any order, in metres"
    )


def _numbers(path: str, k: int, words: list[str], width: int) -> list[float]:
    """Return the ``width`` numbers of line ``k``."""
    if len(words) != width or width not in (3, 6, 7):
        raise FileError(path, f"line {k} has {len(words)} columns; expected are {_COLUMNS}")
    numbers = []
    for word in words:
        try:
            numbers.append(number_of(word))
        except ValueError:
            raise FileError(path, f"line {k}: {word!r} is not a number") from None
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
