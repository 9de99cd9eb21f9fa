"""The text for ``--help``: the purpose of a node, and its parameters from their specifications."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Iterable
from dataclasses import replace

from continuum.arm import SECTION_PARAMETERS
from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.parameters import ARM_PREFIX, ARM_SECTIONS, SIM_TIME

WIDTH = 100
"""Longest line."""


def usage(node_class: type[CheckedNode]) -> str:
    """Return how to start a node, and its parameters with description, unit, range and default."""
    package = node_class.__module__.partition(".")[0]
    arm = " --params-file ARM.yaml" if node_class.HAS_ARM else ""
    parts = [
        f"usage: ros2 run {package} {node_class.NAME} --ros-args{arm} -p NAME:=VALUE ...",
        _summary(node_class),
        "parameters, each as -p NAME:=VALUE, or in a file of --params-file:\n"
        + _table((*node_class.all_parameter_specs(), SIM_TIME)),
    ]
    if node_class.HAS_ARM:
        sections = replace(ARM_SECTIONS, name=ARM_PREFIX + ARM_SECTIONS.name)
        parts.append(
            "the arm, in one file for all nodes:\n"
            + _table(
                (sections, *(replace(spec, name=f"{ARM_PREFIX}<section>.{spec.name}") for spec in SECTION_PARAMETERS))
            )
        )
    parts.append("rename the node: -r __node:=NAME; a topic: -r OLD:=NEW")
    return "\n\n".join(parts)


def _summary(node_class: type[CheckedNode]) -> str:
    words = " ".join(inspect.getdoc(node_class).split()).replace("``", "")
    return textwrap.fill(words, WIDTH)


def _table(specs: Iterable[ParameterSpec]) -> str:
    return "\n".join(line for spec in specs for line in _entry(spec))


def _entry(spec: ParameterSpec) -> tuple[str, ...]:
    text = f"{spec.description}; {spec.allowed}; {_default(spec)}"
    return (
        f"  {spec.name}",
        textwrap.fill(text, WIDTH, initial_indent=" " * 6, subsequent_indent=" " * 6, break_on_hyphens=False),
    )


def _default(spec: ParameterSpec) -> str:
    if spec.default is None:
        return "required"
    if isinstance(spec.default, bool):
        return f"default {str(spec.default).lower()}"
    return f"default {spec.default if spec.default != '' else 'empty'}"
