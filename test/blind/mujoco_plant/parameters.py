"""Parameters of the arm without any effect: the prototype's, and their ordinary variation from arm to arm."""

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

JOINTS = 5
GRAVITY = 9.80665  # [m/s^2]


@dataclass(frozen=True)
class Parameters:
    """A planar section hanging down; arrays have the shape (5,), joint or link 1 nearest the base.

    Joint friction is tau_mu w + tau_c sign(w) (1 + S exp(-|w / v_d|^p)), with p = 2 in the thesis (Eq. 13).

    Attributes:
        mass: of the links [kg].
        inertia: of the links about their centres of mass, which are b beyond their joints [kg m^2].
        stiffness: of the joints [N m/rad].
        rest_angle: where the joints' springs are at rest [rad].
        viscous: tau_mu [N m s/rad].
        coulomb: tau_c [N m].
        stribeck: S.
        stribeck_rate: v_d [rad/s].
        stribeck_exponent: p.
        hole_radius: a, from the arm's axis to the cables' holes [m].
        half_spacing: b, from a disc to the next joint [m].
        cable_friction: mu_c between cable and disc.
        base_tilt: turns the base plate as a joint before the first would [rad].
    """

    mass: np.ndarray
    inertia: np.ndarray
    stiffness: np.ndarray
    rest_angle: np.ndarray
    viscous: np.ndarray
    coulomb: np.ndarray
    stribeck: np.ndarray
    stribeck_rate: np.ndarray
    stribeck_exponent: float = 2.0
    hole_radius: float = 0.032
    half_spacing: float = 0.01925
    cable_friction: float = 0.2
    base_tilt: float = 0.0

    def with_(self, **changes: Any) -> "Parameters":
        return replace(self, **changes)

    def scaled(self, name: str, joint: int | None, factor: float) -> "Parameters":
        """One array times a factor, at one joint (counted from 1) or at all of them."""
        value = getattr(self, name).copy()
        value[slice(None) if joint is None else joint - 1] *= factor
        return replace(self, **{name: value})

    def named(self) -> dict[str, Any]:
        """All of them as plain numbers and lists."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in values.items()}


def prototype() -> Parameters:
    """Tables 1 and 3 of the thesis."""
    each = np.ones(JOINTS)
    return Parameters(
        mass=np.array([222.57, 222.57, 222.57, 222.57, 201.33]) * 1e-3,
        inertia=np.array([79398.0, 79398.0, 79398.0, 79398.0, 76822.0]) * 1e-9,
        stiffness=1.2379 * each,
        rest_angle=0.0 * each,
        viscous=0.0314 * each,
        coulomb=0.0413 * each,
        stribeck=0.7472 * each,
        stribeck_rate=0.2994 * each,
    )


# Relative half widths of uniform variation: (common to all joints of an arm, of each joint by itself). Masses,
# geometry and the cables' friction vary little, since they are known from a scale, a caliper and a bench test; were
# they to vary more, a plant without any effect would hold the effects `inertia` and `capstan`.
VARIATION = {
    "mass": (0.015, 0.005),
    "inertia": (0.03, 0.01),
    "stiffness": (0.20, 0.015),
    "viscous": (0.40, 0.02),
    "coulomb": (0.40, 0.02),
    "stribeck": (0.40, 0.02),
    "stribeck_rate": (0.30, 0.0),
    "cable_friction": (0.03, 0.0),
}


def varied(rng: np.random.Generator, amount: float = 1.0) -> Parameters:
    """Parameters of one arm out of many; ``amount`` scales VARIATION."""
    p = prototype()
    for name, (common, single) in VARIATION.items():
        value = getattr(p, name)
        factor = (1 + amount * common * rng.uniform(-1, 1)) * (1 + amount * single * rng.uniform(-1, 1, JOINTS))
        p = p.with_(**{name: value * factor if isinstance(value, np.ndarray) else float(value * factor[0])})
    return p
