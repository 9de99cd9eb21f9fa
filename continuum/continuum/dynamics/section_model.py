"""The dynamic model in an arm file: a section's geometry and masses, and its block ``dynamics``.

::

    arm:
      sections: [section_1]
      section_1:
        n_joints: 5
        half_spacing: 0.015
        hole_radius: 0.02
        cable_azimuths_deg: [0.0, 180.0, 90.0, 270.0]
        mass: 0.03
        inertia: 5.0e-6
        dynamics: {center_of_mass: 0.015, stiffness: 0.2}

A section stands for itself: its base is fixed, and it carries no further sections. The block holds the remaining
parameters of a model file, each as a number in SI units or as in a model file, and also ``inputs`` and ``effects``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from continuum.arm import DYNAMICS, SECTION_UNITS, Arm, Section, arm_block, arm_from_mapping, refuse_unknown
from continuum.dynamics.model import InputKind
from continuum.dynamics.parameters import PARAMETERS
from continuum.errors import FileError, InvalidValueError
from continuum.parameter_keys import GivenValues, common_name, given_values, known_keys, name_of

_OF_SECTION = tuple(name for one in SECTION_UNITS if (name := common_name(one)) in PARAMETERS)
"""Parameters of a model that the section has: half_spacing, hole_radius, mass and inertia."""

DYNAMICS_UNITS = {
    name: parameter.unit
    for name, parameter in PARAMETERS.items()
    if name not in _OF_SECTION and name != "link_length"  # two half_spacing, as the kinematics has it
}
"""SI unit of each parameter in a block ``dynamics``, by its name."""

_BLOCKS = ("inputs", "effects")

_OPPOSITE = 1e-3
"""How far two opposite cables may be from half a turn [rad]: 0.03 mm at the prototype's holes, finer than a drill."""


@dataclass(frozen=True)
class SectionModel:
    """What an arm file says of the dynamics of a section.

    Attributes:
        mapping: as the content of a model file.
        section: its name.
        given: the block ``dynamics``.
    """

    mapping: dict[str, object]
    section: str
    given: GivenValues

    def in_arm_file(self, error: InvalidValueError) -> InvalidValueError:
        """The error of ``mapping``, with the name that the value has in the arm file."""
        first, _, rest = error.name.partition(".")
        where = f"arm.{self.section}.{DYNAMICS}."
        if first == "parameters" and rest in _OF_SECTION:
            return InvalidValueError(f"arm.{self.section}.{rest}", error.value, error.allowed)
        if first == "parameters":
            return self.given.as_written(InvalidValueError(where + rest, error.value, error.allowed), where)
        return InvalidValueError(where + error.name, error.value, error.allowed)


def is_arm_file(content: Mapping[str, object]) -> bool:
    """Whether a file describes an arm, not a model alone."""
    return "arm" in content or "sections" in content


def section_model(
    path: str | Path, content: Mapping[str, object], section: str | None = None, planar: bool = True
) -> SectionModel:
    """The dynamic model of a section.

    Args:
        path: the file, as errors name it.
        content: of an arm file.
        section: name of the section; None where there is only one.
        planar: whether the section moves alone and in the plane of its cables 1 and 2, which are opposite then.

    Raises:
        FileError: there is no block ``dynamics``.
        InvalidValueError: the arm is not valid, has no such section, or lacks what a simulation needs.
    """
    block = arm_block(path, content)
    arm = arm_from_mapping(block)
    blocks = {one.name: given_section(block, one.name) for one in arm.sections}
    if not any(DYNAMICS in one.values for one in blocks.values()):
        raise FileError(
            path,
            "is an arm file, of `info` and `solve`; a simulation also needs a block `dynamics:` in a section of it, "
            "or a model file",
        )
    chosen = _chosen(arm, section)
    where = f"arm.{chosen.name}."
    values = blocks[chosen.name].values
    for name in ("link_mass", "link_inertia"):
        if name not in values:
            allowed = f"{PARAMETERS[common_name(name)].allowed}; a simulation takes no default of the prototype"
            raise InvalidValueError(where + common_name(name), None, allowed)
    if DYNAMICS not in values:
        raise InvalidValueError(where + DYNAMICS, None, "a block with center_of_mass, stiffness, ..")
    given = given_dynamics(values, chosen.name)
    inputs = given.values.get("inputs", InputKind.CABLES.value)
    if planar and inputs == InputKind.CABLES.value:
        _check_opposite(chosen)
    of_section = {"half_spacing": chosen.b, "hole_radius": chosen.a, "mass": chosen.link_mass}
    of_section["inertia"] = chosen.link_inertia
    parameters: dict[str, object] = {name: _entry(name, value, where + name) for name, value in of_section.items()}
    for name in DYNAMICS_UNITS:
        if name in given.values:
            parameters[name] = _entry(name, given.values[name], f"{where}{DYNAMICS}.{given.keys[name]}")
    mapping: dict[str, object] = {"n_joints": chosen.n_joints, "inputs": inputs, "parameters": parameters}
    mapping["effects"] = given.values.get("effects")
    return SectionModel(mapping, chosen.name, given)


def _chosen(arm: Arm, name: str | None) -> Section:
    if name is None and arm.n_sections == 1:
        return arm.sections[0]
    for section in arm.sections:
        if section.name == name:
            return section
    names = " or ".join(section.name for section in arm.sections)
    raise InvalidValueError("section", name, f"{names}; a simulation is of one section, which `section` names")


def given_section(arm: Mapping[str, object], name: str) -> GivenValues:
    """What the block ``arm`` of a file gives for a section."""
    return given_values(cast("Mapping[str, object]", arm[name]), SECTION_UNITS, f"arm.{name}.")


def given_dynamics(values: Mapping[str, object], section: str) -> GivenValues:
    """What the block ``dynamics`` among the values of a section gives, nothing where there is none.

    Raises:
        InvalidValueError: a key in it that is unknown, or of the section itself.
    """
    where = f"arm.{section}.{DYNAMICS}"
    given = given_values(cast("Mapping[str, object]", values.get(DYNAMICS, {})), DYNAMICS_UNITS, f"{where}.")
    for key, value in given.values.items():
        if name_of(key, SECTION_UNITS) or key == "link_length":
            raise InvalidValueError(f"{where}.{key}", value, f"left out of `{DYNAMICS}`: the section itself has it")
    refuse_unknown(where, given.values, [*DYNAMICS_UNITS, *_BLOCKS], known_keys(DYNAMICS_UNITS))
    return given


def _entry(name: str, value: object, source: str) -> Mapping[str, object]:
    """A parameter as a model file has it."""
    return value if isinstance(value, Mapping) else {"value": value, "unit": PARAMETERS[name].unit, "source": source}


def _check_opposite(section: Section) -> None:
    """Cables 1 and 2 of the section are those of the model."""
    first, second = section.cable_azimuths[:2]
    if abs(math.remainder(second - first - math.pi, 2 * math.pi)) > _OPPOSITE:
        allowed = "cables 1 and 2 opposite each other, which bend the model, as 0, 180, 90, 270 degrees; or "
        allowed += f"{DYNAMICS}.inputs: {InputKind.JOINT_TORQUES.value}"
        raise InvalidValueError(f"arm.{section.name}.cable_azimuths", list(section.cable_azimuths), allowed)
