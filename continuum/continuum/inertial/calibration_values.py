"""Calibration of the sensors of one arm: bias, axis and zero of each, and their sources; as a YAML file.

::

    sensors:
    - bias: [0.0031, -0.0012, 0.0008]   # rad/s
      axis: [0.02, 0.998, -0.06]        # unit vector; positive turns bend towards cable 1
      zero: [0.11, 0.06, -9.79]         # m/s2, the specific force while the arm is straight
      source: 8.2 s of rest, 12.1 s of motion
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml

from continuum.arrays import Array
from continuum.errors import FileError, InvalidValueError
from continuum.inertial.inclination import across_axis
from continuum.number_checks import finite_of_shape
from continuum.parameter_file import read_parameter_file
from continuum.whole_file import write_whole

_LARGEST_BIAS = np.radians(10.0)  # rad/s
_UNIT = 1e-3  # by which a written unit vector may be off
_GRAVITY = (8.5, 11.0)  # m/s2; accelerometers read some per cent off
_LEAST_ACROSS = 0.5  # of gravity, across the axis
_KEYS = ("bias", "axis", "zero", "source")


@dataclass(frozen=True)
class Calibration:
    """Calibration of all sensors of an arm, from the base.

    Attributes:
        bias: rates at rest, (n, 3) [rad/s].
        axis: unit vectors along the axes; positive turns bend towards cable 1, (n, 3).
        zero: specific forces at zero joint angles, (n, 3) [m/s2].
        sources: sources of each sensor's values, (n,).

    Raises:
        InvalidValueError: values of another shape or beyond what a sensor can have, or an axis too close to gravity
            for the accelerometer to show the link's turn.
    """

    bias: Array
    axis: Array
    zero: Array
    sources: tuple[str, ...]

    def __post_init__(self) -> None:
        n = len(self.sources)
        for name in ("bias", "axis", "zero"):
            object.__setattr__(self, name, finite_of_shape(name, getattr(self, name), (n, 3)))
        for sensor, (bias, axis, zero) in enumerate(zip(self.bias, self.axis, self.zero, strict=True), start=1):
            _check_one(f"sensor {sensor}", bias, axis, zero)
        object.__setattr__(self, "axis", self.axis / np.linalg.norm(self.axis, axis=1, keepdims=True))

    @property
    def n_sensors(self) -> int:
        """Number of sensors."""
        return len(self.sources)

    @property
    def gravity(self) -> Array:
        """Reading of each accelerometer at rest, (n,) [m/s2]."""
        return np.asarray(np.linalg.norm(self.zero, axis=1))

    def mountings(self, hang_angle: float) -> Array:
        """Return the rotations (n, 3, 3) that turn vectors in the sensors' axes to those of their links.

        In a link's axes, z runs along the link and y along the axis of positive turns.

        Args:
            hang_angle: from the direction of gravity to the straight arm, positive towards positive angles [rad].
        """
        force = np.array([np.sin(hang_angle), 0.0, -np.cos(hang_angle)])
        of_links, of_sensors = _axes(np.array([0.0, 1.0, 0.0]), force), _axes(self.axis, self.zero)
        return np.asarray(of_links.T @ of_sensors)


def _axes(axis: Array, zero: Array) -> Array:
    """Return orthogonal unit vectors, (..., 3, 3) by rows: the axis, the force across it, and across both."""
    across = across_axis(zero, axis)
    across = across / np.linalg.norm(across, axis=-1, keepdims=True)
    return np.stack([axis, across, np.cross(axis, across)], axis=-2)


def _check_one(sensor: str, bias: Array, axis: Array, zero: Array) -> None:
    if np.abs(bias).max() > _LARGEST_BIAS:
        raise InvalidValueError(f"bias of {sensor}", bias.tolist(), f"at most {_LARGEST_BIAS:.3f} rad/s")
    if abs(np.linalg.norm(axis) - 1) > _UNIT:
        raise InvalidValueError(f"axis of {sensor}", axis.tolist(), "a unit vector")
    size = np.linalg.norm(zero)
    if not _GRAVITY[0] <= size <= _GRAVITY[1]:
        raise InvalidValueError(f"zero of {sensor}", zero.tolist(), f"of size {_GRAVITY[0]} to {_GRAVITY[1]} m/s2")
    if np.linalg.norm(across_axis(zero, axis)) < _LEAST_ACROSS * size:
        raise InvalidValueError(f"axis of {sensor}", axis.tolist(), "30 degrees or more away from gravity in zero")


def load_calibration(path: str | Path) -> Calibration:
    """Read a calibration from a file.

    Raises:
        FileError: it cannot be read, or has another form.
        InvalidValueError: values that no sensor has.
    """
    block = read_parameter_file(path)
    sensors = block.get("sensors")
    if set(block) != {"sensors"} or not isinstance(sensors, Sequence) or isinstance(sensors, str) or not sensors:
        raise FileError(path, "is not a calibration of sensors: it must hold `sensors`, a list from the base on")
    for number, sensor in enumerate(sensors, start=1):
        if not isinstance(sensor, Mapping) or set(sensor) != set(_KEYS):
            raise FileError(path, f"sensor {number} must have {', '.join(_KEYS)}, and nothing else")
    try:
        n = len(sensors)
        bias, axis, zero = (finite_of_shape(key, [sensor[key] for sensor in sensors], (n, 3)) for key in _KEYS[:3])
        return Calibration(bias, axis, zero, tuple(str(sensor["source"]) for sensor in sensors))
    except InvalidValueError as error:
        raise InvalidValueError(f"{path}: {error.name}", error.value, error.allowed) from None


def save_calibration(calibration: Calibration, path: str | Path) -> None:
    """Write a file that `load_calibration` reads.

    Raises:
        FileError: it cannot be written.
    """
    rows = zip(calibration.bias, calibration.axis, calibration.zero, calibration.sources, strict=True)
    sensors = [dict(zip(_KEYS, (*(block.tolist() for block in row[:3]), row[3]), strict=True)) for row in rows]
    write_whole(path, yaml.safe_dump({"sensors": sensors}, sort_keys=False, default_flow_style=None, width=120))
