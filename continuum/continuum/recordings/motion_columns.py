"""Names of the columns of an arm's motion in CSV files. Joints and cables count from 1, joints from the base.

Cable 1 bends the arm towards positive angles, and so do positive torques.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

TIME = "t_s"
_NUMBERED = re.compile(r"(?P<letter>[a-z]+)(?P<number>0|[1-9]\d?)(?:_(?P<unit>\w*))?", re.ASCII)


@dataclass(frozen=True)
class Quantity:
    """A quantity with one column for each joint or cable.

    Attributes:
        letter: prefix of its columns.
        units: factor to SI of every unit with which a column may end; tables are written in the first.
    """

    letter: str
    units: Mapping[str, float]

    def column(self, number: int) -> str:
        """Return the column's name of one joint or cable, as in written tables."""
        return f"{self.letter}{number}_{next(iter(self.units))}"

    def names(self, column: str) -> tuple[int, str] | None:
        """Return number and unit from a column's name, whatever the unit; None for another quantity."""
        match = _NUMBERED.fullmatch(column)
        return (int(match["number"]), match["unit"] or "") if match and match["letter"] == self.letter else None


ANGLE = Quantity("q", {"deg": np.pi / 180, "rad": 1.0})
RATE = Quantity("dq", {"deg_s": np.pi / 180, "rad_s": 1.0})
TENSION = Quantity("u", {"N": 1.0})
TORQUE = Quantity("tau", {"Nm": 1.0})
LENGTH = Quantity("l", {"m": 1.0})
QUANTITIES = (ANGLE, RATE, TENSION, TORQUE)


def angle_column(joint: int) -> str:
    """Return the column's name of a joint's angle [degrees]."""
    return ANGLE.column(joint)


def rate_column(joint: int) -> str:
    """Return the column's name of a joint's rate [degrees/s]."""
    return RATE.column(joint)


def tension_column(cable: int) -> str:
    """Return the column's name of a cable's tension at the base [N]."""
    return TENSION.column(cable)


def torque_column(joint: int) -> str:
    """Return the column's name of the torque of a joint's drive [N m]."""
    return TORQUE.column(joint)
