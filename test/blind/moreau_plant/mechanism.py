"""What the arm is made of, as plain numbers: the parameters, and what effects add to them."""

from typing import NamedTuple

import numpy as np

from blind.mujoco_plant.parameters import JOINTS, Parameters


class Mechanism(NamedTuple):
    """Parameters of ``blind.mujoco_plant.parameters`` by the same names, and those of effects; 0 is without the effect.

    Arrays have the shape (5,), joint or link 1 nearest the base, unless stated otherwise.

    Attributes:
        stribeck_exponent: p of the dry friction tau_c (1 + S / (1 + |w / v_d|^p)).
        base_tilt: of the plate, what it is turned by in this recording included [rad].
        hardening: c of the springs' torque -K (theta + c theta^3) [1/rad^2].
        load: a point mass on the tip disc [kg].
        dropping: another one, which falls off [kg] ...
        drop_at: ... at this time since the first row [s].
        base_compliance: of the hinge that carries the base plate [rad/(N m)].
        clearance: half play of each joint [rad].
        presliding: mean angle at which the elements of a joint's friction slip [rad].
        load_friction: dry friction over the force that a joint carries [m].
        drag: c of the force -c v |v| per length across the links [kg/m^2].
        strap: stiffness of the cable to the first sensor [N/m].
        magnet: largest torque of a magnet at each joint [N m].
        rubbing: of discs past an angle [N m/rad].
        kink: share of torque that each joint's spring loses where it has snapped.
        shown: what load cells show over what pulls (2,).
        lag: time constant of the tensions [s].
        compliance: of the cables [m/N].
        sag: of the cables where they are not pulled [m].
        shake: amplitude of the bracket's acceleration [m/s^2].
        shake_rate: of the same [rad/s].
        shake_phase: of the same at the first row [rad].
    """

    mass: np.ndarray
    inertia: np.ndarray
    stiffness: np.ndarray
    rest_angle: np.ndarray
    viscous: np.ndarray
    coulomb: np.ndarray
    stribeck: np.ndarray
    stribeck_rate: np.ndarray
    stribeck_exponent: float
    hole_radius: float
    half_spacing: float
    cable_friction: float
    base_tilt: float
    clearance: np.ndarray
    magnet: np.ndarray
    rubbing: np.ndarray
    kink: np.ndarray
    shown: np.ndarray
    hardening: float = 0.0
    load: float = 0.0
    dropping: float = 0.0
    drop_at: float = np.inf
    base_compliance: float = 0.0
    presliding: float = 0.0
    load_friction: float = 0.0
    drag: float = 0.0
    strap: float = 0.0
    lag: float = 0.0
    compliance: float = 0.0
    sag: float = 0.0
    shake: float = 0.0
    shake_rate: float = 0.0
    shake_phase: float = 0.0

    def at(self, name: str, joint: int, amount: float) -> "Mechanism":
        """Another one, with the amount added to an array at one joint (from 1)."""
        value = getattr(self, name).copy()
        value[joint - 1] += amount
        return self._replace(**{name: value})


def without_effects(p: Parameters) -> Mechanism:
    """The arm of some parameters."""
    clearance, magnet, rubbing, kink = np.zeros((4, JOINTS))
    return Mechanism(
        *(p.mass, p.inertia, p.stiffness, p.rest_angle, p.viscous, p.coulomb, p.stribeck, p.stribeck_rate),
        *map(float, (p.stribeck_exponent, p.hole_radius, p.half_spacing, p.cable_friction, p.base_tilt)),
        *(clearance, magnet, rubbing, kink, np.ones(2)),
    )
