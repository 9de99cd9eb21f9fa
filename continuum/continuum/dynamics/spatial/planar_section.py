"""The thesis's section as a chain in space: joints about y, z along the straight arm, cables 1 and 2 at x = +a and -a.

It hangs along gravity at a hang angle of 0, and positive joint angles turn z towards x, as in Eq. 12.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from continuum.dynamics.parameters import Parameters
from continuum.dynamics.spatial.cable_paths import Cables
from continuum.dynamics.spatial.chain import Chain
from continuum.dynamics.spatial.time_stepping import Joints


class ArmInSpace(NamedTuple):
    """All that a simulation needs of an arm."""

    chain: Chain
    joints: Joints
    cables: Cables


def planar_section(p: Parameters) -> ArmInSpace:
    """Return the section with these parameters; without discs it has no cables."""
    n = p.n_joints
    along = np.zeros((n, 3))
    along[:, 2] = [p.mount[0], *p.joint_spacing[:-1]]
    center = np.zeros((n, 3))
    center[:, 2] = p.center_of_mass
    inertia = np.zeros((n, 6))
    inertia[:, [0, 3, 5]] = p.inertia[:, None]
    beta, g = p.hang_angle[0], p.gravity[0]
    chain = Chain(
        axis=np.tile([0.0, 1.0, 0.0], (n, 1)), offset=along, base=np.eye(3), mass=p.mass, center=center,
        inertia=inertia, rotor=p.rotor_inertia, gravity=g * np.array([-np.sin(beta), 0.0, np.cos(beta)]),
    )  # fmt: skip
    joints = Joints(
        p.stiffness, p.rest_angle, p.viscous_friction, p.coulomb_friction, p.stribeck_gain, p.stribeck_speed
    )
    return ArmInSpace(chain, joints, _two_cables(p) if p.has_cables else no_cables())


def _two_cables(p: Parameters) -> Cables:
    """Cables that come straight out of the base, so that they also bend at the base plate, and end at the last disc."""
    places: list[tuple[int, float, float]] = [(-1, -p.half_spacing[0], p.hole_radius[0]), (-1, 0.0, p.hole_radius[0])]
    for i in range(p.n_joints):
        places.append((i, p.half_spacing[i], p.hole_radius[i]))
        if i < p.n_joints - 1 and p.disc_gap[i] > 0.0:
            places.append((i, p.half_spacing[i] + p.disc_gap[i], p.hole_radius[i + 1]))
    body = np.array([body for body, _, _ in places] * 2)
    hole = np.array([[side * radius, 0.0, z] for side in (1.0, -1.0) for _, z, radius in places])
    both = np.ones(2)
    return Cables(
        first=np.array([0, len(places), 2 * len(places)]), body=body, hole=hole, friction=p.capstan_friction[0] * both,
        slope=p.cable_slope[0] * both, stiffness=0.0 * both, damping=0.0 * both,
    )  # fmt: skip


def no_cables() -> Cables:
    """Return the cables of an arm that drives move."""
    none = np.zeros(0)
    return Cables(np.zeros(1, np.int64), np.zeros(0, np.int64), np.zeros((0, 3)), none, none, none, none)
