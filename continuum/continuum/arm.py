"""Geometry of a section and of an arm of several sections, read from YAML and validated (thesis Fig. 4, Table 1)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from continuum import joint_names
from continuum.did_you_mean import did_you_mean
from continuum.errors import FileError, InvalidValueError
from continuum.parameter_file import read_parameter_file
from continuum.parameter_keys import common_name, given_values, known_keys
from continuum.parameter_spec import ParameterSpec
from continuum.shipped_files import ARMS, find_file

FOUR_CABLES = [0.0, math.pi / 2, math.pi, 3 * math.pi / 2]
"""Azimuths of four cables, a quarter turn apart, as on the prototype [rad]."""

DYNAMICS = "dynamics"
"""Block of a section for simulations alone: `continuum.dynamics.section_model` reads it."""

SECTIONS_PARAMETER = ParameterSpec("sections", str, "names of the sections from the base", is_list=True)

SECTION_PARAMETERS: tuple[ParameterSpec, ...] = (
    ParameterSpec("n_joints", int, "number of spherical joints of the section", lower=1, upper=1000),
    ParameterSpec(
        "b", float, "distance from a disc to the next joint, half the joint spacing", "m", 0.0, 10.0, lower_open=True
    ),
    ParameterSpec("a", float, "radius of the cables' holes from the section's axis", "m", 0.0, 10.0, lower_open=True),
    ParameterSpec(
        "twist", float, "turn of the section about the tip axis of the one before it", "rad", -2 * math.pi,
        2 * math.pi, default=0.0,
    ),
    ParameterSpec(
        "cable_azimuths", float, "azimuth of each actuating cable in the section's frame", "rad", -2 * math.pi,
        2 * math.pi, is_list=True, default=FOUR_CABLES,
    ),
    ParameterSpec(
        "bend_limit", float, "largest total bend of the section", "rad", 0.0, 100.0, lower_open=True,
        default=math.pi,
    ),
    ParameterSpec("link_mass", float, "mass of one link", "kg", 0.0, 1e3, lower_open=True, default=0.22257),
    ParameterSpec(
        "link_inertia", float, "inertia of one link about its centre of mass, across the axis", "kg m2",
        0.0, 1e3, lower_open=True, default=79398e-9,
    ),
)  # fmt: skip

# The defaults of link_mass and link_inertia are those of the prototype, thesis Table 1.

SECTION_UNITS = {spec.name: spec.unit for spec in SECTION_PARAMETERS}
"""SI unit of each parameter of a section, by its name."""


def _default(name: str) -> Any:
    """Default of a section's parameter; of a list, as a tuple."""
    (value,) = [spec.default for spec in SECTION_PARAMETERS if spec.name == name]
    return tuple(value) if isinstance(value, list) else value


@dataclass(frozen=True)
class Section:
    """One inextensible section: ``n_joints`` spherical joints between discs, bent by cables on its last disc.

    A joint sits ``b`` above one disc and ``b`` below the next, so the section is ``2 n_joints b`` long when straight
    and its joints are ``2 b`` apart.

    Attributes:
        name: unique in the arm; prefixes the names of joints and cables.
        n_joints: number of joints (n_j).
        b: distance disc to joint [m].
        a: radius of the cables' holes [m].
        twist: turn about z from the tip frame of the section before it to this section's base frame [rad].
        cable_azimuths: azimuth alpha_j of each actuating cable [rad], at least three.
        bend_limit: largest total bend theta [rad].
        link_mass: mass of one link [kg].
        link_inertia: inertia of one link about its centre of mass, across its axis [kg m2].

    Raises:
        InvalidValueError: a value is out of its range, or the cables cannot hold the section.
    """

    name: str
    n_joints: int
    b: float
    a: float
    twist: float = _default("twist")
    cable_azimuths: tuple[float, ...] = _default("cable_azimuths")
    bend_limit: float = _default("bend_limit")
    link_mass: float = _default("link_mass")
    link_inertia: float = _default("link_inertia")

    def __post_init__(self) -> None:
        joint_names.check_section(self.name)
        for spec in SECTION_PARAMETERS:
            value = spec.check(getattr(self, spec.name), f"{self.name}.")
            object.__setattr__(self, spec.name, tuple(value) if isinstance(value, list) else value)
        distinct = {round(azimuth % (2 * math.pi), 9) % round(2 * math.pi, 9) for azimuth in self.cable_azimuths}
        if len(distinct) < 3 or len(distinct) < len(self.cable_azimuths):
            raise InvalidValueError(
                f"{self.name}.cable_azimuths", list(self.cable_azimuths), "three or more azimuths, all different"
            )
        if self.bend_limit >= self.contact_bend:
            raise InvalidValueError(
                f"{self.name}.bend_limit",
                self.bend_limit,
                f"less than {self.contact_bend:.6g} rad, where the cable holes of neighbouring discs meet "
                "(2 n_joints atan(b / a))",
            )

    @property
    def length(self) -> float:
        """Length of the backbone from base disc to tip disc [m]; it does not change when the section bends."""
        return 2 * self.n_joints * self.b

    @property
    def contact_bend(self) -> float:
        """Total bend at which a cable hole meets the one on the next disc [rad]: the chord of Eq. 8 becomes zero."""
        return 2 * self.n_joints * math.atan2(self.b, self.a)

    @property
    def cable_names(self) -> tuple[str, ...]:
        """Names of the actuating cables, counted from 1."""
        return joint_names.cable_names(self.name, len(self.cable_azimuths))

    @property
    def phi_joint(self) -> str:
        """Name of the joint at the base that turns the bending plane (thesis appendix A)."""
        return joint_names.phi_joint(self.name)

    @property
    def theta_joints(self) -> tuple[str, ...]:
        """Names of the bending joints from base to tip; each turns by theta / n_joints."""
        return joint_names.theta_joints(self.name, self.n_joints)

    @property
    def phi_back_joint(self) -> str:
        """Name of the joint at the tip that turns back by -phi."""
        return joint_names.phi_back_joint(self.name)

    @property
    def base_frame(self) -> str:
        """Name of the frame P at the section's base, twist included."""
        return f"{self.name}_base"

    @property
    def tip_frame(self) -> str:
        """Name of the frame D on the section's last disc."""
        return f"{self.name}_tip"

    @property
    def disc_frames(self) -> tuple[str, ...]:
        """Names of the frames on the section's discs, from its base to its tip; none of them turns with phi."""
        between = (f"{self.name}_disc_{k}" for k in range(1, self.n_joints))
        return (self.base_frame, *between, self.tip_frame)


@dataclass(frozen=True)
class Arm:
    """Sections one after the other, the first at the base.

    Raises:
        InvalidValueError: no section, or two of one name.
    """

    sections: tuple[Section, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "sections", tuple(self.sections))
        names = [section.name for section in self.sections]
        if not names or len(set(names)) < len(names):
            raise InvalidValueError("arm.sections", names, "one or more names, all different")

    @property
    def n_sections(self) -> int:
        return len(self.sections)

    @property
    def length(self) -> float:
        """Length of the backbone [m]."""
        return sum(section.length for section in self.sections)

    @property
    def cable_names(self) -> tuple[str, ...]:
        """Names of all cables, by section from the base."""
        return tuple(name for section in self.sections for name in section.cable_names)


def arm_from_mapping(mapping: Mapping[str, object]) -> Arm:
    """Build an arm from ``{"sections": [name, ...], name: {"n_joints": ..., "b": ..., "a": ..., ...}, ...}``.

    ``half_spacing``, ``hole_radius``, ``mass`` and ``inertia`` are other names of ``b``, ``a``, ``link_mass`` and
    ``link_inertia``, and a key may end in ``_deg``, ``_mm`` or ``_g``. The block ``dynamics`` of a section is not read.

    Raises:
        InvalidValueError: a parameter is missing, unknown, given twice or out of range; the message names it.
    """
    names = [str(name) for name in SECTIONS_PARAMETER.check_list(mapping.get("sections"), "arm.")]
    refuse_unknown("arm", mapping, ["sections", *names])
    return Arm(tuple(_section_from_mapping(name, mapping.get(name)) for name in names))


def _section_from_mapping(name: str, block: object) -> Section:
    known = [*SECTION_UNITS, DYNAMICS]
    if not isinstance(block, Mapping):
        raise InvalidValueError(f"arm.{name}", block, f"a block with {', '.join(known)}")
    given = given_values(block, SECTION_UNITS, f"arm.{name}.")
    values = {key: value for key, value in given.values.items() if key != DYNAMICS}
    refuse_unknown(f"arm.{name}", values, known, known_keys(SECTION_UNITS))
    if not isinstance(block.get(DYNAMICS, {}), Mapping):
        raise InvalidValueError(f"arm.{name}.{DYNAMICS}", block[DYNAMICS], "a block of parameters by name")
    for spec in SECTION_PARAMETERS:
        if spec.default is None and spec.name not in values:
            other = f", also by the name {common_name(spec.name)}" if common_name(spec.name) != spec.name else ""
            raise InvalidValueError(f"arm.{name}.{spec.name}", None, spec.allowed + other)
    try:
        return Section(name=name, **values)  # type: ignore[arg-type]  # what they are is checked there
    except InvalidValueError as error:
        left_out = error.name in {f"{name}.{spec.name}" for spec in SECTION_PARAMETERS if spec.name not in values}
        hint = "; it was left out, and this is its default: set it" if left_out else ""
        in_file = InvalidValueError(f"arm.{error.name}", error.value, error.allowed + hint)
        raise given.as_written(in_file, f"arm.{name}.") from None


def refuse_unknown(where: str, mapping: Mapping[str, object], known: Sequence[str], others: Sequence[str] = ()) -> None:
    """Refuse a block with a key that is neither among ``known`` nor among ``others``, further forms of these.

    Raises:
        InvalidValueError: there is one; the message has the name that it is near to.
    """
    for name in mapping:
        if name not in known and name not in others:
            hint = did_you_mean(str(name), [*known, *others]) or f"; known: {', '.join(known)}"
            raise InvalidValueError(f"{where}.{name}", mapping[name], f"no parameter of this name{hint}")


def arm_to_mapping(arm: Arm) -> dict[str, object]:
    """The mapping that :func:`arm_from_mapping` reads back to the same arm."""
    blocks: dict[str, object] = {"sections": [section.name for section in arm.sections]}
    for section in arm.sections:
        values = {key: list(v) if isinstance(v, tuple) else v for key, v in asdict(section).items() if key != "name"}
        blocks[section.name] = values
    return blocks


def load_arm(path: str | Path) -> Arm:
    """Read an arm from YAML: a ROS 2 parameter file (``/**: ros__parameters: arm: ...``) or its ``arm`` block alone.

    A bare name that is no file here is an arm that comes with the library.

    Raises:
        FileError: the file cannot be read or holds no arm.
        InvalidValueError: the arm in it is not valid.
    """
    block = arm_block(path, read_parameter_file(find_file(path, ARMS)))
    try:
        return arm_from_mapping(block)
    except InvalidValueError as error:
        raise InvalidValueError(f"{path}: {error.name}", error.value, error.allowed) from None


def arm_block(path: str | Path, content: Mapping[str, object]) -> Mapping[str, object]:
    """The block of a file from which `arm_from_mapping` builds the arm.

    Raises:
        FileError: there is none; ``path`` names the file.
    """
    arm = content.get("arm", content)
    if "n_joints" in content and "parameters" in content:
        raise FileError(
            path, "is a model file, of `simulate` and `diagnose`; expected an arm file, with a block `arm:`"
        )
    if not isinstance(arm, Mapping) or "sections" not in arm:
        raise FileError(path, "holds no arm; expected a block `arm:` with `sections: [...]` in it")
    return arm


def prototype_section() -> Section:
    """The section of the prototype."""
    return load_arm(ARMS / "prototype.yaml").sections[0]
