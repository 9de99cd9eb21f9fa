"""Defaults that an arm file leaves to the library, and which of them are of another arm."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping
from typing import Any, NamedTuple

from continuum.arm import DYNAMICS, SECTION_PARAMETERS, Arm, Section, prototype_section
from continuum.dynamics.parameters import PARAMETERS
from continuum.dynamics.section_model import DYNAMICS_UNITS, given_dynamics, given_section
from continuum.parameter_keys import common_name

_OF_PROTOTYPE = ("link_mass", "link_inertia")
"""Parameters whose default is measured on the prototype (thesis Table 1)."""

_PROTOTYPE = ": the prototype's"
_WIDTH = 80
"""Columns of a narrow terminal."""


class TakenDefault(NamedTuple):
    """A default that was taken.

    Attributes:
        section: name of the section.
        name: the key that may be written in the section, as ``mass`` or ``dynamics.gravity``.
        value: in SI units.
        unit: SI unit, empty for a pure number.
        of_prototype: it was measured on the prototype.
        other_size: it was, and the links of this section have another size.
    """

    section: str
    name: str
    value: object
    unit: str
    of_prototype: bool = False
    other_size: bool = False


def taken_defaults(block: Mapping[str, object], arm: Arm) -> list[TakenDefault]:
    """The defaults that were taken for an arm.

    Args:
        block: the block ``arm`` of its file.
        arm: as it was built from that.

    Raises:
        InvalidValueError: a key in a block ``dynamics`` that is not known.
    """
    prototype = prototype_section()
    taken = []
    for section in arm.sections:
        values = given_section(block, section.name).values
        other = not same_size(section, prototype)
        for spec in SECTION_PARAMETERS:
            if spec.default is not None and spec.name not in values:
                of = spec.name in _OF_PROTOTYPE
                name, value = common_name(spec.name), spec.default
                taken.append(TakenDefault(section.name, name, value, spec.unit, of, of and other))
        if DYNAMICS not in values:
            continue
        given = given_dynamics(values, section.name).values
        for name in DYNAMICS_UNITS:
            default, unit = PARAMETERS[name].default, PARAMETERS[name].unit
            if default is not None and name not in given:
                taken.append(TakenDefault(section.name, f"{DYNAMICS}.{name}", default, unit if unit != "1" else ""))
    return taken


def same_size(section: Section, other: Section) -> bool:
    """Whether the links of two sections have the same length and the same radius of holes."""
    return math.isclose(section.b, other.b) and math.isclose(section.a, other.a)


def in_lines(taken: list[TakenDefault], arm: Arm) -> list[str]:
    """A line for each default, with the sections that it was taken for if not for all; then the doubtful ones."""
    lines: dict[str, list[str]] = {}
    for one in taken:
        text = f"  {one.name}: {_in_words(one.value, one.unit)}, default{_PROTOTYPE * one.of_prototype}"
        lines.setdefault(text, []).append(one.section)
    every = [section.name for section in arm.sections]
    found = [f"{text}, of {', '.join(of)}" if of != every else text for text, of in lines.items()]
    found += warnings(taken)
    return [part for line in found for part in textwrap.wrap(line, _WIDTH, subsequent_indent="    ")]


def warnings(taken: list[TakenDefault]) -> list[str]:
    """A line for each default that was measured on links of another size."""
    sections: dict[str, list[str]] = {}
    for one in taken:
        if one.other_size:
            sections.setdefault(one.name, []).append(one.section)
    return [
        f"warning: {name}{_PROTOTYPE}, whose links have another size; give that of {', '.join(of)}"
        for name, of in sections.items()
    ]


def _in_words(value: Any, unit: str) -> str:
    """A number, or a list of them, with the unit; angles in degrees."""
    items = list(value) if isinstance(value, list | tuple) else [value]
    if unit == "rad":
        items, unit = [round(math.degrees(one), 2) for one in items], "deg"
    return " ".join([*(f"{one:g}" for one in items), unit]).rstrip()
