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
    """What joints or cables have a column of each.

    Attributes:
        letter: with which its columns begin.
        units: factor to SI of every unit that a column may end with; tables are written in the first.
    """

    letter: str
    units: Mapping[str, float]

    def column(self, number: int) -> str:
        """Of one joint or cable, as tables are written."""
        return f"{self.letter}{number}_{next(iter(self.units))}"

    def names(self, column: str) -> tuple[int, str] | None:
        """Number and unit that a column's name gives, whatever the unit; None where it is of something else."""
        match = _NUMBERED.fullmatch(column)
        return (int(match["number"]), match["unit"] or "") if match and match["letter"] == self.letter else None


ANGLE = Quantity("q", {"deg": np.pi / 180, "rad": 1.0})
RATE = Quantity("dq", {"deg_s": np.pi / 180, "rad_s": 1.0})
TENSION = Quantity("u", {"N": 1.0})
TORQUE = Quantity("tau", {"Nm": 1.0})
QUANTITIES = (ANGLE, RATE, TENSION, TORQUE)


def angle_column(joint: int) -> str:
    """Angle of a joint [degrees]."""
    return ANGLE.column(joint)


def rate_column(joint: int) -> str:
    """Rate of a joint [degrees/s]."""
    return RATE.column(joint)


def tension_column(cable: int) -> str:
    """Tension of a cable at the base [N]."""
    return TENSION.column(cable)


def torque_column(joint: int) -> str:
    """Torque of a joint's drive [N m]."""
    return TORQUE.column(joint)
