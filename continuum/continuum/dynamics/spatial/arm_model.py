"""The dynamics of an arm file in space: the bodies, joints and cables of all its sections.

Each joint of a section is a universal joint that turns by u about x of the section's frame, then by v about y. To first
order these are Allen's (u, v), the components of the rotation vector that the kinematics use; Rx(u) Ry(v) has a torsion
of u v / 2 beyond that. The cables run through the discs of all sections before theirs, at their own radius and azimuth,
as in `continuum.kinematics.routing`, and bend at the base plate, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.arm import Arm, Section, arm_block, arm_from_mapping
from continuum.arrays import Array, Integers
from continuum.dynamics.model import InputKind, Model
from continuum.dynamics.model_file import section_models
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.spatial.cable_paths import Cables
from continuum.dynamics.spatial.chain import Chain
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
        n_joints = np.array([section.n_joints for section in self.arm.sections])
        each: Array = np.asarray(w, dtype=float) / n_joints[:, None]
        return each[self.section[::2]].reshape(-1)


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
        InvalidValueError: a model has effects or is driven by torques, or the sections state different gravity.
    """
    for section, model in zip(arm.sections, models, strict=True):
        if model.effects:
            names = ", ".join(active.effect.name for active in model.effects)
            raise InvalidValueError(f"arm.{section.name}.dynamics.effects", names, "none, of an arm in space")
        if model.inputs is not InputKind.CABLES:
            raise InvalidValueError(f"arm.{section.name}.dynamics.inputs", model.inputs.value, "cables, in space")
        for name in ("gravity", "hang_angle"):
            first, value = (float(getattr(one.parameters, name)[0]) for one in (models[0], model))
            if value != first:
                allowed = f"{first:g}, as of {arm.sections[0].name}: one of the whole arm"
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
    inertia[1::2, 0] = inertia[1::2, 3] = inertia[1::2, 5] = per_joint("inertia")
    g, beta = float(parameters[0].gravity[0]), float(parameters[0].hang_angle[0])
    gravity = g * np.array([-np.sin(beta) * c[0], -np.sin(beta) * s[0], np.cos(beta)])
    rest = np.zeros(2 * n_links)
    rest[1::2] = per_joint("rest_angle")
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
