"""Targets of the tip as they come from the command line or from a file."""

from __future__ import annotations

import argparse
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
    rotation = _rotations("--quaternion", [options.quaternion])[0] if options.quaternion else None
    return Target(position, options.direction, rotation)


def read_targets(path: str) -> Targets:
    """Targets of a text file; commas and what follows a # count as blanks.

    Raises:
        FileError: it cannot be read, or its lines are not of numbers.
        InvalidValueError: a target is malformed.
    """
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(path, f"cannot be read ({error})") from error
    words = [line.partition("#")[0].replace(",", " ").split() for line in lines]
    try:
        rows = np.array([[float(word) for word in row] for row in words if row])
    except ValueError as error:
        raise FileError(path, f"holds no targets ({error}); wanted are {_COLUMNS}") from error
    if rows.ndim != 2 or rows.shape[1] not in (3, 6, 7):
        raise FileError(path, f"holds no targets; wanted are {_COLUMNS}")
    more = rows[:, 3:] if rows.shape[1] > 3 else None
    if rows.shape[1] == 7:
        return Targets(rows[:, :3], rotations=_rotations("quaternion", rows[:, 3:]))
    return Targets(rows[:, :3], more)


def _rotations(name: str, quaternions: object) -> Array:
    values = finite_of_shape(name, quaternions, (-1, 4))
    lengths = np.linalg.norm(values, axis=1)
    if not np.all((lengths > 1e-9) & (lengths < 1e9)):
        raise InvalidValueError(name, values[np.argmin(lengths)].tolist(), "four numbers, not all zero")
    rotations: Array = Rotation.from_quat(values).as_matrix()
    return rotations
