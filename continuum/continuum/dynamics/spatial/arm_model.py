"""The dynamics of an arm file in space: the bodies, joints and cables of all its sections.

Each joint of a section is a universal joint that turns by u about x of the section's frame, then by v about y. To first
order these are Allen's (u, v), the components of the rotation vector that the kinematics use; Rx(u) Ry(v) also rolls
about the arm, by u v / 2. `ArmModel.bent` gives angles at which all joints and the tip are where the kinematics have
them. The cables run through the discs of all sections before theirs, at their own radius and azimuth, as in
`continuum.kinematics.routing`, and bend at the base plate, too. As in the planar model, a spring's rest angle and the
hang angle are positive towards cable 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from continuum.arm import Arm, Section, arm_block, arm_from_mapping
from continuum.arrays import Array, Integers
from continuum.dynamics.model import InputKind, Model
from continuum.dynamics.model_file import section_models
from continuum.dynamics.parameters import PARAMETERS, Parameters
from continuum.dynamics.spatial.cable_paths import Cables
from continuum.dynamics.spatial.chain import Chain
from continuum.dynamics.spatial.terms import body_poses
from continuum.dynamics.spatial.time_stepping import Joints
from continuum.errors import InvalidValueError
from continuum.parameter_file import read_parameter_file
from continuum.shipped_files import ARMS, find_file

HOLDING_STIFFNESS, HOLDING_DAMPING = 2e4, 20.0
"""Stiffness [N/m] and damping [N s/m] of a cable whose motor holds a length: 1 mm of stretch at 20 N."""


@dataclass(frozen=True)
class ArmModel:
    """An arm in space.

    Attributes:
        arm: its geometry.
        chain, joints, cables: its dynamics; the world is ``base_link``.
        section: index of the section of each degree of freedom, (n,).
        tip: position of the last disc in the frame of the last body, (3,) [m].
        mount: distance from the centre of the base plate to the first joint [m].
    """

    arm: Arm
    chain: Chain
    joints: Joints
    cables: Cables
    section: Integers
    tip: Array
    mount: float

    @property
    def n(self) -> int:
        """Number of degrees of freedom."""
        return int(self.section.size)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the degrees of freedom: the bends u and v of each joint."""
        return tuple(
            f"{section.name}_{bend}_{joint}"
            for section in self.arm.sections
            for joint in range(1, section.n_joints + 1)
            for bend in ("u", "v")
        )

    @property
    def cable_names(self) -> tuple[str, ...]:
        """Names of the cables, by section from the base."""
        return self.arm.cable_names

    def bent(self, w: Array) -> Array:
        """Angles (n,) [rad] at which each section bends by ``w`` (n_sections, 2) [rad], equally over its joints."""
        angles, roll = [], 0.0
        for section, bend in zip(self.arm.sections, np.asarray(w, dtype=float), strict=True):
            for _ in range(section.n_joints):
                c, s = np.cos(roll), np.sin(roll)
                x, y = bend / section.n_joints
                vector = [c * x - s * y, s * x + c * y, 0.0]
                u, v, rolled = Rotation.from_rotvec(vector).as_euler("XYZ")  # Rx(u) Ry(v) Rz(rolled)
                roll += rolled
                angles += [u, v]
        return np.array(angles)

    def bends(self, q: Array) -> Array:
        """Bend of each section as Allen's (u, v), (n_times, n_sections, 2) [rad], at angles ``q`` (n_times, n) [rad].

        It leads from the direction of the section's base to that of its tip.
        """
        turns = np.cumsum([section.twist for section in self.arm.sections])
        rotations = body_poses(self.chain, self.checked(q))[1]
        ends = 2 * np.cumsum([section.n_joints for section in self.arm.sections]) - 1
        base = np.broadcast_to(np.eye(3), rotations[:, 0].shape)
        found = []
        for end, turn in zip(ends, turns, strict=True):
            x, y, z = np.einsum("tji,tj->it", base, rotations[:, end, :, 2])
            theta, phi = np.arctan2(np.hypot(x, y), z), np.arctan2(y, x) - turn
            found.append(np.stack([-theta * np.sin(phi), theta * np.cos(phi)], axis=-1))
            base = rotations[:, end]
        return np.stack(found, axis=1)

    def checked(self, q: Array) -> Array:
        """Return angles as contiguous floats, (n_times, n) [rad].

        Raises:
            InvalidValueError: they have another shape.
        """
        angles = np.ascontiguousarray(q, dtype=float)
        if angles.ndim != 2 or angles.shape[1] != self.n:
            raise InvalidValueError("shape of the angles", angles.shape, f"(n_times, {self.n})")
        return angles


def load_arm_model(path: str | Path) -> ArmModel:
    """The dynamics of an arm file whose sections all have a block ``dynamics``.

    Raises:
        FileError: the file cannot be read, or holds no arm or no block ``dynamics``.
        InvalidValueError: a value is missing or not allowed.
    """
    content = read_parameter_file(find_file(path, ARMS))
    try:
        arm = arm_from_mapping(arm_block(path, content))
        return arm_model(arm, section_models(path, content, [section.name for section in arm.sections]))
    except InvalidValueError as error:
        raise InvalidValueError(f"{path}: {error.name}", error.value, error.allowed) from None


def arm_model(arm: Arm, models: Sequence[Model]) -> ArmModel:
    """An arm whose sections have the parameters of these models.

    Raises:
        InvalidValueError: a model has effects or is driven by torques, or a section states another gravity or hang
            angle than the first, whose values are those of the arm.
    """
    for section, model in zip(arm.sections, models, strict=True):
        if model.effects:
            names = ", ".join(active.effect.name for active in model.effects)
            raise InvalidValueError(f"arm.{section.name}.dynamics.effects", names, "none, of an arm in space")
        if model.inputs is not InputKind.CABLES:
            raise InvalidValueError(f"arm.{section.name}.dynamics.inputs", model.inputs.value, "cables, in space")
        for name in ("gravity", "hang_angle"):
            first, value = (float(getattr(one.parameters, name)[0]) for one in (models[0], model))
            if value != first and name in model.sources:
                allowed = f"left out, or {first:g} {PARAMETERS[name].unit}, as of {arm.sections[0].name}"
                raise InvalidValueError(f"arm.{section.name}.dynamics.{name}", value, allowed)
    turns = np.cumsum([section.twist for section in arm.sections])
    parameters = [model.parameters for model in models]
    chain, joints = _bodies(arm.sections, turns, parameters)
    last = arm.sections[-1]
    numbers = np.repeat(np.arange(arm.n_sections), [2 * section.n_joints for section in arm.sections])
    tip, mount = np.array([0.0, 0.0, last.b]), arm.sections[0].b
    return ArmModel(arm, chain, joints, _cables(arm.sections, turns, parameters), numbers, tip, mount)


def _bodies(sections: Sequence[Section], turns: Array, parameters: Sequence[Parameters]) -> tuple[Chain, Joints]:
    """Two degrees of freedom for each joint: about x, without mass, and about y, with the link."""
    n_links = sum(section.n_joints for section in sections)

    def per_joint(name: str) -> Array:
        return np.concatenate([getattr(p, name) for p in parameters])

    def per_freedom(name: str) -> Array:
        return np.repeat(per_joint(name), 2)

    psi = np.repeat(turns, [section.n_joints for section in sections])
    c, s, none = np.cos(psi), np.sin(psi), np.zeros(n_links)
    axis = np.stack([np.stack([c, s, none], axis=1), np.stack([-s, c, none], axis=1)], axis=1).reshape(-1, 3)
    b = np.repeat([section.b for section in sections], [section.n_joints for section in sections])
    offset = np.zeros((2 * n_links, 3))
    offset[::2, 2] = b + np.append(0.0, b[:-1])  # from the joint before, the first from the base plate
    mass, center, inertia = np.zeros(2 * n_links), np.zeros((2 * n_links, 3)), np.zeros((2 * n_links, 6))
    mass[1::2], center[1::2, 2] = per_joint("mass"), per_joint("center_of_mass")
    inertia[1::2, 0] = inertia[1::2, 3] = per_joint("inertia")
    a = np.repeat([section.a for section in sections], [section.n_joints for section in sections])
    inertia[1::2, 5] = np.minimum(0.5 * mass[1::2] * a**2, 2.0 * per_joint("inertia"))  # as in the arm's URDF
    g, beta = float(parameters[0].gravity[0]), float(parameters[0].hang_angle[0])
    towards = turns[0] + sections[0].cable_azimuths[0]
    gravity = g * np.array([-np.sin(beta) * np.cos(towards), -np.sin(beta) * np.sin(towards), np.cos(beta)])
    cable_1 = np.repeat([section.cable_azimuths[0] for section in sections], [one.n_joints for one in sections])
    rest = np.zeros(2 * n_links)
    rest[::2], rest[1::2] = -per_joint("rest_angle") * np.sin(cable_1), per_joint("rest_angle") * np.cos(cable_1)
    chain = Chain(axis, offset, np.eye(3), mass, center, inertia, per_freedom("rotor_inertia"), gravity)
    names = ("viscous_friction", "coulomb_friction", "stribeck_gain", "stribeck_speed")
    return chain, Joints(per_freedom("stiffness"), rest, *map(per_freedom, names))


def _cables(sections: Sequence[Section], turns: Array, parameters: Sequence[Parameters]) -> Cables:
    """Cables that come straight out of the base, through one hole in each disc."""
    body, hole, first = [], [], [0]
    ends = 2 * np.cumsum([section.n_joints for section in sections]) - 1
    b = np.repeat([section.b for section in sections], [section.n_joints for section in sections])
    mount = sections[0].b
    for section, turn, end in zip(sections, turns, ends, strict=True):
        for azimuth in section.cable_azimuths:
            x, y = section.a * np.cos(turn + azimuth), section.a * np.sin(turn + azimuth)
            links = np.arange(1, end + 1, 2)
            body += [-1, -1, *links]
            hole += [[x, y, -mount], [x, y, 0.0], *([x, y, b[link // 2]] for link in links)]
            first.append(len(body))
    number = [len(section.cable_azimuths) for section in sections]
    friction, slope = (np.repeat([float(getattr(p, name)[0]) for p in parameters], number)
                       for name in ("capstan_friction", "cable_slope"))  # fmt: skip
    each = np.ones(sum(number))
    return Cables(
        np.array(first), np.array(body), np.array(hole), friction, slope, HOLDING_STIFFNESS * each,
        HOLDING_DAMPING * each,
    )  # fmt: skip
