"""A planar model from a URDF: one chain of joints whose axes are parallel.

The angles of the model equal those of the URDF up to sign and offset: the joints of a model are at zero if its links
lie on a straight line, those of a URDF in the drawn configuration. Let p_i be the positions of the joints in the URDF's
zero configuration, seen along the first joint's axis, and phi_i the direction from p_i to p_i+1 relative to that of the
first link. Then

    theta_i = s_i q_i + (phi_i - phi_i-1),     s_i = 1 if axis i points in the direction of the first one, else -1.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
import yourdfpy

from continuum.arrays import Array
from continuum.dynamics.model import InputKind, Model, NamedJoint
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.urdf_description import Body, Description
from continuum.errors import FileError

_PARALLEL = 1e-4  # rad: rounding in descriptions
_SHORTEST = 1e-4  # m: shortest link, as in model files
_ROUNDING = 1e-9  # rad: of 64-bit numbers in a chain of a thousand joints
_OFFSET = 0.01  # largest distance of a link's centre of mass from the line between joints, per length of the link


@dataclass(frozen=True)
class UrdfChain:
    """A model, and the relation of its joints to those of the description.

    Attributes:
        model: the model, driven by joint torques; its ``joints`` have this relation.
        tip: the link whose frame is the tip; None if the last link is assumed to end at twice the distance of its
            centre of mass.
    """

    model: Model
    tip: str | None

    @property
    def joints(self) -> tuple[str, ...]:
        """Names in the URDF from base to tip."""
        return tuple(one.name for one in self.model.joints)

    @property
    def signs(self) -> Array:
        """The s_i, (n_joints,)."""
        return np.array([one.sign for one in self.model.joints])

    @property
    def zeros(self) -> Array:
        """Angles of the model in the URDF's zero configuration, (n_joints,) [rad]."""
        return np.array([one.zero for one in self.model.joints])


def chain_from_urdf(
    path: str | Path, tip: str | None = None, gravity: Sequence[float] = (0.0, 0.0, -9.81)
) -> UrdfChain:
    """Read a serial arm that moves in one plane.

    Args:
        path: path of the URDF.
        tip: name of the link whose frame is the tip; by default the last frame that is fixed to the last link.
        gravity: acceleration of gravity in the frame of the URDF's root, (3,) [m/s^2].

    Raises:
        FileError: the file is not a readable URDF, or does not describe a serial planar arm.
        InvalidValueError: a value is not allowed in a model.
    """
    path = Path(path)
    joints, axes, places, groups = Description(path).chain()
    axis = axes[0]
    if np.max(np.linalg.norm(np.cross(axes, axis), axis=1)) > _PARALLEL:
        raise FileError(path, "has joints whose axes are not parallel; an arm that bends in a plane is needed")
    bodies = [_lumped(path, joint.child, group.bodies) for joint, group in zip(joints, groups, strict=True)]
    end, tip = _end(path, tip, places[-1], groups[-1].frames, bodies[-1])
    along = np.array([_within(b - a, axis) for a, b in pairwise([*places, end])])
    lengths = np.linalg.norm(along, axis=1)
    if np.any(lengths < _SHORTEST):
        raise FileError(
            path, f"has no distance from joint {joints[int(np.argmin(lengths))].name} to the next, or to the tip"
        )
    directions = along / lengths[:, None]
    centres = np.array([_within(one.centre - place, axis) for one, place in zip(bodies, places, strict=True)])
    ahead = np.sum(centres * directions, axis=1)
    offset = np.linalg.norm(centres - ahead[:, None] * directions, axis=1)
    if np.any(offset > _OFFSET * lengths):
        worst = int(np.argmax(offset / lengths))
        raise FileError(
            path,
            f"has a link whose centre of mass lies {1e3 * offset[worst]:.3g} mm off the line from joint "
            f"{joints[worst].name} to the next, or to the tip; models allow at most "
            f"{1e3 * _OFFSET * lengths[worst]:.3g} mm here",
        )
    pull = _within(np.asarray(gravity, dtype=float), axis)
    weight = float(np.linalg.norm(pull))
    turned = np.array([_angle(directions[0], one, axis) for one in directions])
    zeros = np.diff(turned, prepend=0.0)
    model = Model(
        Parameters(
            mass=np.array([one.mass for one in bodies]),
            inertia=np.array([axis @ one.inertia @ axis for one in bodies]),
            center_of_mass=ahead,
            link_length=lengths,
            viscous_friction=np.array([_dynamics(path, joint, "damping") for joint in joints]),
            coulomb_friction=np.array([_dynamics(path, joint, "friction") for joint in joints]),
            gravity=np.array([weight]),
            hang_angle=np.array([_angle(pull, directions[0], axis) if weight > 0 else 0.0]),
        ),
        inputs=InputKind.JOINT_TORQUES,
        joints=tuple(
            NamedJoint(joint.name, float(sign), _rounded(float(zero)))
            for joint, sign, zero in zip(joints, np.sign(axes @ axis), zeros, strict=True)
        ),
    )
    return UrdfChain(model, tip)


def _rounded(zero: float) -> float:
    """Return an angle within half a turn; 0 for one of rounding errors."""
    within = (zero + math.pi) % math.tau - math.pi
    return 0.0 if abs(within) < _ROUNDING else within


def _lumped(path: Path, name: str, bodies: Sequence[Body]) -> Body:
    """Combine bodies into one by the parallel axis theorem."""
    mass = sum(one.mass for one in bodies)
    if not 0 < mass < np.inf:
        raise FileError(
            path, f"has a link {name} of mass {mass:g}; every link of a model needs a finite, positive mass"
        )
    centre = np.sum([one.mass * one.centre for one in bodies], axis=0) / mass
    inertia = np.zeros((3, 3))
    for one in bodies:
        away = one.centre - centre
        inertia += one.inertia + one.mass * (away @ away * np.eye(3) - np.outer(away, away))
    return Body(mass, centre, inertia)


def _end(path: Path, tip: str | None, last: Array, frames: Mapping[str, Array], body: Body) -> tuple[Array, str | None]:
    """Return the position of the tip (3,) [m], and the link whose frame it is."""
    if tip is not None and tip not in frames:
        raise FileError(path, f"has no link {tip} beyond its last joint; it has {', '.join(frames)}")
    farther = [name for name, place in frames.items() if np.linalg.norm(place - last) > _SHORTEST]
    tip = tip if tip is not None or not farther else farther[-1]
    return (2 * body.centre - last, None) if tip is None else (frames[tip], tip)


def _dynamics(path: Path, joint: yourdfpy.urdf.Joint, name: str) -> float:
    given = None if joint.dynamics is None else getattr(joint.dynamics, name)
    try:
        return 0.0 if given is None else float(given)
    except ValueError as error:
        raise FileError(path, f"has a joint {joint.name} with the {name} {given!r}; a number is needed") from error


def _within(vector: Array, axis: Array) -> Array:
    """Return the component of a vector (3,) in the plane normal to an axis (3,)."""
    return vector - (vector @ axis) * axis


def _angle(start: Array, end: Array, axis: Array) -> float:
    """Return the angle from one direction in the plane to another, positive about the axis [rad]."""
    return float(np.arctan2(axis @ np.cross(start, end), start @ end))
