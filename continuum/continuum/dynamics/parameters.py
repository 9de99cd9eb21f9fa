"""The physical parameters of Eq. 12: one object with symbols, units and bounds; every one may be given per joint."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from continuum.dynamics.expressions import Numbers
from continuum.errors import InvalidValueError


@dataclass(frozen=True)
class Parameter:
    """What one parameter means and may be.

    Attributes:
        symbol: as in the thesis.
        unit: SI unit, "1" for a pure number.
        lower, upper: bounds of what makes physical sense, inclusive.
        per_joint: may differ from joint to joint; else one number for the section.
        meaning: one sentence.
        default: used where a model file leaves it out; None makes it required.
        typical: size that it has where it matters, the scale of fits; without, the model's own value is.
        per_recording: differs from recording to recording, as a sensor's offset after each start.
    """

    symbol: str
    unit: str
    lower: float
    upper: float
    per_joint: bool
    meaning: str
    default: float | None = None
    typical: float | None = None
    per_recording: bool = False

    @property
    def allowed(self) -> str:
        """The allowed values in words."""
        number = "a finite number, or one for each joint," if self.per_joint else "a finite number"
        return f"{number} from {self.lower:g} to {self.upper:g} {self.unit}"

    def array(self, value: object, n_joints: int, name: str) -> Numbers:
        """``value`` as an array, (n_joints,) or (1,) [unit].

        Raises:
            InvalidValueError: not a number, not finite, out of bounds, or as many as there are neither joints nor one.
        """
        size = n_joints if self.per_joint else 1
        items = list(value) if isinstance(value, list | tuple) else list(np.atleast_1d(value))  # type: ignore[call-overload]
        if any(
            isinstance(item, bool) or not isinstance(item, int | float | np.integer | np.floating) for item in items
        ):
            raise InvalidValueError(name, value, self.allowed)
        try:
            numbers = np.array([float(item) for item in items])
        except OverflowError as error:  # a whole number beyond all floats
            raise InvalidValueError(name, value, self.allowed) from error
        if numbers.size not in (1, size) or not np.all((numbers >= self.lower) & (numbers <= self.upper)):
            raise InvalidValueError(name, value, self.allowed + f" ({size} joints)" * self.per_joint)
        return np.broadcast_to(numbers, (size,)).copy()


def _joint(symbol: str, unit: str, lower: float, upper: float, meaning: str, default: float | None = None) -> Any:
    return field(metadata={"parameter": Parameter(symbol, unit, lower, upper, True, meaning, default)})


def _section(symbol: str, unit: str, lower: float, upper: float, meaning: str, default: float | None = None) -> Any:
    return field(metadata={"parameter": Parameter(symbol, unit, lower, upper, False, meaning, default)})


@dataclass(frozen=True)
class Parameters:
    """Values of the parameters, (n_joints,) or (1,) each: floats, or symbols while a model is compiled.

    Joints and links count from the base. Link i lies between joint i and joint i + 1 and carries disc i.
    """

    mass: Numbers = _joint("m", "kg", 1e-6, 1e3, "mass of a link with its disc and sensor")
    inertia: Numbers = _joint("I_z", "kg m2", 0.0, 1e3, "inertia of a link about its centre of mass, in the plane")
    center_of_mass: Numbers = _joint("c", "m", -10.0, 10.0, "centre of mass beyond the link's joint")
    half_spacing: Numbers = _joint("b", "m", 1e-4, 10.0, "from a joint to the discs before and after it")
    hole_radius: Numbers = _joint("a", "m", 1e-4, 10.0, "from the axis to the cables' holes in these discs")
    stiffness: Numbers = _joint("K", "N m/rad", 0.0, 1e4, "stiffness of a joint's spring, Eq. 12")
    rest_angle: Numbers = _joint("theta_0", "rad", -math.pi, math.pi, "angle of a joint's relaxed spring, Eq. 12", 0.0)
    viscous_friction: Numbers = _joint("tau_mu", "N m s/rad", 0.0, 1e3, "viscous friction of a joint, Eq. 13")
    coulomb_friction: Numbers = _joint("tau_c", "N m", 0.0, 1e3, "Coulomb friction of a joint, Eq. 13")
    stribeck_gain: Numbers = _joint("S", "1", 0.0, 100.0, "relative size of the Stribeck effect, Eq. 13")
    stribeck_speed: Numbers = _joint("v_d", "rad/s", 1e-3, 1e3, "Stribeck speed, Eq. 13")
    friction_slope: Numbers = _section("k_v", "s/rad", 1.0, 1e6, "slope of the smoothed sign of joint speed, Eq. 13")
    capstan_friction: Numbers = _section("mu_c", "1", 0.0, 2.0, "friction of cables on discs, Eqs. 14 and 15", 0.0)
    cable_slope: Numbers = _section("k_l", "s/m", 1.0, 1e6, "slope of the smoothed sign of cable speed, Eq. 15", 2e3)
    gravity: Numbers = _section("g", "m/s2", 0.0, 100.0, "acceleration of gravity", 9.81)
    hang_angle: Numbers = _section(
        "beta",
        "rad",
        -math.pi,
        math.pi,
        "from the direction of gravity to the straight arm, positive towards positive joint angles; 0 hangs",
        0.0,
    )

    def named(self) -> dict[str, Numbers]:
        """The arrays by name, in the order of declaration."""
        return {name: getattr(self, name) for name in PARAMETERS}

    @property
    def joint_spacing(self) -> Numbers:
        """From each joint to the next, b_i + b_(i+1), and to the tip disc's far side for the last, (n,) [m]."""
        return self.half_spacing + np.append(self.half_spacing[1:], self.half_spacing[-1:])

    @property
    def contact_angle(self) -> Numbers:
        """Angle of each joint at which the cable holes of its two discs meet, 2 atan(b / a), (n,) [rad]."""
        return 2 * np.arctan2(self.half_spacing, self.hole_radius)

    @property
    def n_joints(self) -> int:
        """Number of joints."""
        return len(self.mass)


PARAMETERS: dict[str, Parameter] = {f.name: f.metadata["parameter"] for f in dataclasses.fields(Parameters)}
"""What each field of `Parameters` means and may be."""
