"""An arm file for people: every parameter with its meaning and unit, also those that are left out."""

from __future__ import annotations

import math
from collections.abc import Mapping

import yaml

from continuum.arm import DYNAMICS, SECTION_PARAMETERS, Arm, Section
from continuum.dynamics.parameters import PARAMETERS, Parameter
from continuum.dynamics.section_model import DYNAMICS_UNITS
from continuum.parameter_keys import common_name
from continuum.printable import one_line

_HEAD = """\
# An arm of {sections}, from the base to the tip. Kinematics, URDF, nodes and simulations read this file.
# Units: m, rad, kg, s and what follows from them. A key may end in _deg, _mm or _g: its value is then in that unit.
# Check: continuum info FILE lists all that is left out here, with the values that are taken for it.
# URDF: ros2 run continuum_description create_continuum_robot --arm FILE; continuum.urdf.xacro knows no units in keys.
"""

_OF_DYNAMICS = """\
        # For simulations: of one section in the plane of its cables 1 and 2, of several in space. A value is one number
        # for all joints, or a list from the base. Lines that begin with # are left out: take the # away and put in
        # your value. Of springs and friction, `continuum identify` finds the values from recordings.
"""


def commented_arm(arm: Arm, dynamics: Mapping[str, float], remarks: Mapping[str, str]) -> str:
    """The text of a ROS 2 parameter file that `load_arm` and `load_model` read.

    Args:
        arm: the arm.
        dynamics: values of the block ``dynamics`` of every section, in SI units, by the names of `Parameters`.
        remarks: where a value comes from, by the name of the parameter.
    """
    sections = "1 section" if arm.n_sections == 1 else f"{arm.n_sections} sections"
    names = ", ".join(section.name for section in arm.sections)
    lines = [_HEAD.format(sections=sections), "/**:\n  ros__parameters:\n    arm:\n", f"      sections: [{names}]\n"]
    for section in arm.sections:
        lines += _section(section, dynamics, remarks, explained=section is arm.sections[0])
    return "".join(lines)


def _section(section: Section, dynamics: Mapping[str, float], remarks: Mapping[str, str], explained: bool) -> list[str]:
    """The block of a section; comments stand in the first one alone."""
    lines = [f"      {section.name}:\n"]
    for spec in SECTION_PARAMETERS:
        name = common_name(spec.name)
        value = getattr(section, spec.name)
        in_degrees = _exact_degrees(value) if spec.unit == "rad" else None
        key, shown = (name, value) if in_degrees is None else (f"{name}_deg", in_degrees)
        unit = "deg" if in_degrees is not None else spec.unit
        if explained:
            lines.append(f"        # {_with_unit(spec.description, unit)}{_remark(remarks, name)}\n")
        lines.append(f"        {key}: {_yaml(shown)}\n")
    if explained:
        lines.append(_OF_DYNAMICS)
    lines.append(f"        {DYNAMICS}:\n")
    for name in DYNAMICS_UNITS:
        parameter = PARAMETERS[name]
        if explained:
            lines.append(f"          # {_explained(parameter)}{_remark(remarks, name)}\n")
        if name in dynamics:
            lines.append(f"          {name}: {_yaml(float(dynamics[name]))}\n")
        elif explained:
            lines.append(f"          # {name}: {_yaml(float(parameter.default or 0.0))}\n")
    return lines


def _explained(parameter: Parameter) -> str:
    left_out = "" if parameter.default is None else f"; {parameter.default:g} where it is left out"
    return _with_unit(f"{parameter.symbol}: {parameter.meaning}", parameter.unit) + left_out


def _with_unit(text: str, unit: str) -> str:
    return f"{text} [{unit}]" if unit not in ("", "1") else text


def _remark(remarks: Mapping[str, str], name: str) -> str:
    return f"; {one_line(remarks[name])}" if name in remarks else ""


def _exact_degrees(value: float | tuple[float, ...]) -> float | list[float] | None:
    """Angles [rad] in degrees, None where degrees with twelve decimals are not exactly the same."""
    angles = value if isinstance(value, tuple) else (value,)
    degrees = [round(math.degrees(angle), 12) for angle in angles]
    if tuple(map(math.radians, degrees)) != tuple(angles):
        return None
    return degrees if isinstance(value, tuple) else degrees[0]


def _yaml(value: object) -> str:
    """A value as YAML writes it."""
    plain = list(value) if isinstance(value, tuple) else value
    return yaml.safe_dump(plain, default_flow_style=True, width=10**6).removesuffix("...\n").strip()
