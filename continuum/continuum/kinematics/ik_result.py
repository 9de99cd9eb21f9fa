"""What an inverse kinematics solver answers: a typed result with a status, never an exception for a hard target."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.errors import InvalidValueError


class IkStatus(enum.IntEnum):
    """How a target was answered. The numbers are those of the message ``continuum_msgs/IkStatus``."""

    SOLVED = 0
    LIMIT_REACHED = 1
    UNREACHABLE = 2
    NO_CONVERGENCE = 3


@dataclass(frozen=True)
class IkResult:
    """A configuration and how well it meets its target.

    Attributes:
        configuration: Allen coordinates (n_sections, 2) [rad].
        status: SOLVED within the tolerance; otherwise why not, and the configuration is the nearest that was found.
        iterations: iterations spent.
        distance: from the tip to the target position [m].
        angle: from the tip's z axis to the target direction [rad]; 0 where the direction is free.
    """

    configuration: Array
    status: IkStatus
    iterations: int
    distance: float
    angle: float

    @property
    def solved(self) -> bool:
        return self.status is IkStatus.SOLVED


@dataclass(frozen=True)
class Target:
    """Where the tip shall be, and optionally where its z axis shall point.

    Attributes:
        position: (3,) [m] in ``base_link``.
        direction: unit vector (3,), or None where it is free. A vector of another length is normalised.

    Raises:
        InvalidValueError: wrong shape, not finite, or a direction of length zero.
    """

    position: Array
    direction: Array | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "position", _finite("position", self.position, (3,), "three finite numbers [m]"))
        if self.direction is not None:
            direction = _finite("direction", self.direction, (3,), "three finite numbers, not all zero")
            length = float(np.linalg.norm(direction))
            if length < 1e-12:
                raise InvalidValueError("direction", direction.tolist(), "three finite numbers, not all zero")
            object.__setattr__(self, "direction", direction / length)


def configuration_of(arm: Arm, start: Array | None) -> Array:
    """``start`` as an array (n_sections, 2) [rad], or the straight arm.

    Raises:
        InvalidValueError: wrong shape or not finite.
    """
    if start is None:
        return np.zeros((arm.n_sections, 2))
    shape = (arm.n_sections, 2)
    return _finite("start", start, shape, f"finite numbers of shape {shape} [rad]")


def _finite(name: str, value: object, shape: tuple[int, ...], allowed: str) -> Array:
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise InvalidValueError(name, value, allowed) from None
    if array.shape != shape or not np.all(np.isfinite(array)):
        raise InvalidValueError(name, array.tolist(), allowed)
    return array
