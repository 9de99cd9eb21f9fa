"""A node's parameters: declared from their specifications with description, type and range, fixed after start."""

from __future__ import annotations

import sys
from array import array
from collections.abc import Iterable, Mapping
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node

from continuum.arm import DYNAMICS, SECTION_PARAMETERS, Arm, arm_from_mapping, arm_to_mapping
from continuum.did_you_mean import did_you_mean
from continuum.errors import ContinuumError, InvalidValueError
from continuum.parameter_spec import ParameterSpec, Value

SIM_TIME = ParameterSpec("use_sim_time", bool, "take the time from /clock", default=False)
OF_EVERY_NODE = (SIM_TIME.name, "start_type_description_service")
OF_EVERY_NODE_PREFIX = "qos_overrides."
INTEGERS = range(-(2**63), 2**63)
"""Range of integers in ROS parameters."""

ARM_PREFIX = "arm."
ARM_SECTIONS = ParameterSpec("sections", str, "names of the arm's sections from the base", is_list=True)


class UnknownParameterError(ContinuumError):
    """A given parameter is unknown to the node."""

    def __init__(self, name: str, known: Iterable[str]) -> None:
        names = list(known)
        super().__init__(f"unknown parameter {name!r}{did_you_mean(name, names) or f'; known: {", ".join(names)}'}")


def given_parameters(node: Node) -> dict[str, object]:
    """Return the node's parameters from the command line and files, without those that every ROS node has.

    The node must have been created with ``automatically_declare_parameters_from_overrides=True``.

    Raises:
        InvalidValueError: a parameter that every ROS node has is wrong.
    """
    SIM_TIME.check(node.get_parameter(SIM_TIME.name).value)
    names = [
        name
        for name in node.list_parameters([], 0).names
        if name not in OF_EVERY_NODE and not name.startswith(OF_EVERY_NODE_PREFIX)
    ]
    return {parameter.name: _plain(parameter.value) for parameter in node.get_parameters(names)}


def declare_parameters(node: Node, specs: Iterable[ParameterSpec], given: Mapping[str, object]) -> dict[str, Value]:
    """Check the given values against ``specs`` and declare them; missing parameters get their defaults.

    Raises:
        InvalidValueError: a value has the wrong type or is out of range, or a parameter without a default is missing.
    """
    values = {}
    for spec in specs:
        value = spec.check(given.get(spec.name, spec.default))
        _declare(node, spec, spec.name, value)
        values[spec.name] = value
    return values


def declare_arm(node: Node, given: Mapping[str, object], default: Arm | None = None) -> Arm:
    """Build the arm from the parameters ``arm.*`` and declare them, defaults included; use ``default`` without them.

    They are declared with the names and units of their specifications, whatever names and units the file uses.
    Parameters for simulations only are declared unchanged.

    Raises:
        ContinuumError: no arm is given.
        InvalidValueError: one of its parameters is missing, unknown or out of range.
    """
    block = _nested({name: value for name, value in given.items() if _is_of_arm(name)}).get("arm")
    if block is None and default is not None:
        block = arm_to_mapping(default)
    if block is None:
        raise ContinuumError(
            "no arm is given; start the node with --ros-args --params-file ARM.yaml, the file of an arm such as "
            "continuum_description/config/three_sections.yaml"
        )
    if not isinstance(block, Mapping):
        raise InvalidValueError(
            "arm", block, "a block arm.sections, arm.<section>.n_joints, ..., for example from --params-file"
        )
    arm = arm_from_mapping(block)
    for name, value in arm_to_mapping(arm).items():
        if name == ARM_SECTIONS.name:
            _declare(node, ARM_SECTIONS, ARM_PREFIX + name, value)
            continue
        for spec in SECTION_PARAMETERS:
            _declare(node, spec, f"{ARM_PREFIX}{name}.{spec.name}", value[spec.name])
    declared = {f"{ARM_PREFIX}{section.name}.{spec.name}" for section in arm.sections for spec in SECTION_PARAMETERS}
    for name, value in given.items():
        if _is_of_arm(name) and name not in declared | {ARM_PREFIX + ARM_SECTIONS.name}:
            _declare_other(node, name, value)
    return arm


def refuse_unknown(given: Iterable[str], specs: Iterable[ParameterSpec], with_arm: bool) -> None:
    """Refuse unknown parameters; those of the arm are checked with the arm.

    Raises:
        UnknownParameterError: a parameter is unknown; the message names the first one and the known ones.
    """
    known = [spec.name for spec in specs]
    for name in given:
        if name not in known and not (with_arm and _is_of_arm(name)):
            raise UnknownParameterError(name, [*known, *(["arm.*"] if with_arm else []), *OF_EVERY_NODE])


def describe(spec: ParameterSpec) -> ParameterDescriptor:
    """Return the descriptor of a parameter for ROS tools."""
    unit = f" [{spec.unit}]" if spec.unit else ""
    descriptor = ParameterDescriptor(
        description=spec.description + unit, additional_constraints=spec.allowed, read_only=True
    )
    bounded = spec.lower > -sys.float_info.max or spec.upper < sys.float_info.max
    if spec.kind is float and bounded:
        lower, upper = max(spec.lower, -sys.float_info.max), min(spec.upper, sys.float_info.max)
        descriptor.floating_point_range = [FloatingPointRange(from_value=lower, to_value=upper)]
    if spec.kind is int and bounded:
        lower, upper = max(spec.lower, INTEGERS[0]), min(spec.upper, INTEGERS[-1])
        descriptor.integer_range = [IntegerRange(from_value=int(lower), to_value=int(upper))]
    return descriptor


def _declare(node: Node, spec: ParameterSpec, name: str, value: Value) -> None:
    if spec.kind is int and not spec.is_list and value not in INTEGERS:
        raise InvalidValueError(name, value, f"{spec.allowed}, of 64 bits")
    if node.has_parameter(name):
        node.undeclare_parameter(name)
    if value == []:
        return  # an empty list has no type in ROS; an undeclared parameter is equivalent
    node.declare_parameter(name, value, describe(spec), ignore_override=True)


def _declare_other(node: Node, name: str, value: Any) -> None:
    """Make a parameter for simulations read-only; remove other names of declared parameters."""
    node.undeclare_parameter(name)
    if name.split(".")[2:3] == [DYNAMICS]:
        for_simulations = ParameterDescriptor(description="read by simulations of the section", read_only=True)
        node.declare_parameter(name, value, for_simulations, ignore_override=True)


def _is_of_arm(name: str) -> bool:
    return name == "arm" or name.startswith(ARM_PREFIX)


def _nested(flat: Mapping[str, object]) -> dict[str, object]:
    """Return nested blocks from dotted names.

    Raises:
        InvalidValueError: a name is both a value and a block.
    """
    root: dict[str, object] = {}
    for name, value in sorted(flat.items()):
        *blocks, last = name.split(".")
        here = root
        for depth, block in enumerate(blocks):
            inner = here.setdefault(block, {})
            if not isinstance(inner, dict):
                raise InvalidValueError(".".join(blocks[: depth + 1]), inner, "a block of parameters")
            here = inner
        here[last] = value
    return root


def _plain(value: object) -> object:
    """Convert ``array.array``, in which lists of numbers arrive, to plain lists."""
    return list(value) if isinstance(value, array) else value
