"""The physical parameters of Eq. 12: one object with symbols, units and bounds; most may differ between joints."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from continuum.dynamics.expressions import Numbers
from continuum.errors import InvalidValueError

RATIO = ", minus 1"
"""Ending of the description of a parameter that is a ratio minus one."""


class ByHand(NamedTuple):
    """A measurement by hand: its standard deviation [unit of the parameter], and its procedure in one sentence."""

    sd: float
    how: str


@dataclass(frozen=True)
class Parameter:
    """Description and bounds of one parameter.

    Attributes:
        symbol: symbol in the thesis.
        unit: SI unit, "1" for a pure number.
        lower, upper: physically meaningful bounds, inclusive.
        per_joint: whether it may differ between joints; otherwise one number holds for the section.
        meaning: description in one phrase.
        default: value if a model file omits it; None makes it required.
        typical: typical size where the parameter matters, the scale of fits; None uses the model's value.
        per_recording: whether it differs between recordings, like the offset of a sensor after each start.
        ordinary: standard deviation between parts of one batch; a diagnosis tolerates it without naming an effect.
        shape: whether it describes the shape of an effect and not its size, although its default is 0.
        by_hand: measurement by hand, with its accuracy; None if there is none, or if the value is relative to one that
            a fit changes.
        optional: whether the parameter, without a default, may be absent: an arm may lack the part that it describes.
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
    optional: bool = False
    ordinary: float = 0.0
    shape: bool = False
    by_hand: ByHand | None = None

    @property
    def another_value(self) -> float:
        """A value within the bounds that differs from the default by about the typical size [unit]."""
        origin, step = self.default or 0.0, self.typical or 1.0
        above, below = min(origin + step, self.upper), max(origin - step, self.lower)
        return above if above > origin else below

    @property
    def allowed(self) -> str:
        """The allowed values in words."""
        number = "a finite number, or one for each joint," if self.per_joint else "a finite number"
        return f"{number} from {self.lower:g} to {self.upper:g} {self.unit}"

    def array(self, value: object, n_joints: int, name: str) -> Numbers:
        """Return ``value`` as an array, (n_joints,) or (1,) [unit].

        Raises:
            InvalidValueError: an item is not a finite number within the bounds, or their number is neither 1 nor
                that of the joints.
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
    return _field(Parameter(symbol, unit, lower, upper, True, meaning, default))


def _if_any(symbol: str, unit: str, lower: float, upper: float, meaning: str) -> Any:
    return _field(Parameter(symbol, unit, lower, upper, True, meaning, optional=True))


def _section(symbol: str, unit: str, lower: float, upper: float, meaning: str, default: float | None = None) -> Any:
    return _field(Parameter(symbol, unit, lower, upper, False, meaning, default))


def _field(parameter: Parameter) -> Any:
    if parameter.default is None and not parameter.optional:
        return field(metadata={"parameter": parameter})
    return field(default=None, metadata={"parameter": parameter})


@dataclass(frozen=True, kw_only=True)
class Parameters:
    """Values of the parameters, (n_joints,) or (1,) each: floats, or symbols while a model is compiled.

    Joints and links count from the base. Link i lies between joint i and joint i + 1 and carries disc i if the arm has
    discs. An omitted parameter has its default; an omitted optional one is None and not a value of the model. Without
    ``link_length`` the spacing follows from the discs (`joint_spacing`); an arm without ``half_spacing`` has neither
    discs nor cables.

    Raises:
        InvalidValueError: both ``link_length`` and ``half_spacing`` are missing.
    """

    mass: Numbers = _joint("m", "kg", 1e-6, 1e3, "mass of a link with its disc and sensor")
    inertia: Numbers = _joint("I_z", "kg m2", 0.0, 1e3, "inertia of a link about its centre of mass, in the plane")
    center_of_mass: Numbers = _joint("c", "m", -10.0, 10.0, "centre of mass beyond the link's joint")
    link_length: Numbers = _if_any("d", "m", 1e-4, 10.0, "from a joint to the next, from the last to the tip")
    half_spacing: Numbers = _if_any("b", "m", 1e-4, 10.0, "from a joint to the discs before and after it")
    hole_radius: Numbers = _if_any("a", "m", 1e-4, 10.0, "from the axis to the cables' holes in these discs")
    rotor_inertia: Numbers = _joint("J_r", "kg m2", 0.0, 1e3, "inertia of a joint's drive, reflected to the joint", 0.0)
    stiffness: Numbers = _joint("K", "N m/rad", 0.0, 1e4, "stiffness of a joint's spring, Eq. 12", 0.0)
    rest_angle: Numbers = _joint("theta_0", "rad", -math.pi, math.pi, "angle of a joint's relaxed spring, Eq. 12", 0.0)
    viscous_friction: Numbers = _joint("tau_mu", "N m s/rad", 0.0, 1e3, "viscous friction of a joint, Eq. 13", 0.0)
    coulomb_friction: Numbers = _joint("tau_c", "N m", 0.0, 1e3, "Coulomb friction of a joint, Eq. 13", 0.0)
    stribeck_gain: Numbers = _joint("S", "1", 0.0, 100.0, "relative size of the Stribeck effect, Eq. 13", 0.0)
    stribeck_speed: Numbers = _joint("v_d", "rad/s", 1e-3, 1e3, "Stribeck speed, Eq. 13", 0.3)
    friction_slope: Numbers = _section(
        "k_v", "s/rad", 1.0, 1e6, "slope of the smoothed sign of joint speed, Eq. 13", 300.0
    )
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

    def __post_init__(self) -> None:
        if self.link_length is None and self.half_spacing is None:
            allowed = PARAMETERS["link_length"].allowed + "; it may be omitted only if half_spacing is given"
            raise InvalidValueError("link_length", None, allowed)
        for name, parameter in PARAMETERS.items():
            if getattr(self, name) is None and parameter.default is not None:
                size = self.n_joints if parameter.per_joint else 1
                object.__setattr__(self, name, np.full(size, parameter.default))

    def named(self) -> dict[str, Numbers]:
        """Return the arrays by name, in the order of declaration, without absent optional parameters."""
        return {name: value for name in PARAMETERS if (value := getattr(self, name)) is not None}

    @property
    def has_cables(self) -> bool:
        """Whether the arm has discs with holes for cables."""
        return self.half_spacing is not None and self.hole_radius is not None

    @property
    def joint_spacing(self) -> Numbers:
        """Distance from each joint to the next, and from the last to the tip, (n,) [m].

        The length of the links; if that is omitted, b_i + b_(i+1), and for the last joint to the tip disc's far side.
        """
        return self._between_discs if self.link_length is None else self.link_length

    @property
    def disc_gap(self) -> Numbers:
        """Distance from the disc after a joint to the disc before the next joint, (n,) [m]; 0 if they are the same."""
        if self.link_length is None or self.half_spacing is None:
            return np.zeros(self.n_joints)
        return self.link_length - self._between_discs

    @property
    def middle(self) -> Numbers:
        """Distance from each joint to the disc of its link, or to the middle of a link without disc, (n,) [m]."""
        return self.link_length / 2 if self.half_spacing is None else self.half_spacing

    @property
    def tip(self) -> Numbers:
        """Distance from the last joint to the tip disc, or to the end of a last link without disc, (1,) [m]."""
        return self.link_length[-1:] if self.half_spacing is None else self.half_spacing[-1:]

    @property
    def mount(self) -> Numbers:
        """Distance from the centre of the base plate to joint 1, (1,) [m]; 0 without discs."""
        return np.zeros(1) if self.half_spacing is None else self.half_spacing[:1]

    @property
    def contact_angle(self) -> Numbers:
        """Angle of each joint at which the cable holes of its two discs meet, (n,) [rad]; infinite without holes."""
        if not self.has_cables:
            return np.full(self.n_joints, np.inf)
        return 2 * np.arctan2(self.half_spacing, self.hole_radius)

    @property
    def _between_discs(self) -> Numbers:
        """b_i + b_(i+1), (n,) [m]."""
        return self.half_spacing + np.append(self.half_spacing[1:], self.half_spacing[-1:])

    @property
    def n_joints(self) -> int:
        """Number of joints."""
        return len(self.mass)


PARAMETERS: dict[str, Parameter] = {f.name: f.metadata["parameter"] for f in dataclasses.fields(Parameters)}
"""Description and bounds of each field of `Parameters`."""
