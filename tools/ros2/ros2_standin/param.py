"""``ros2 param list|get|set|dump|describe``."""

from __future__ import annotations

import argparse
import sys

import rclpy
from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterType, ParameterValue
from rclpy.parameter import get_parameter_value, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient

from ros2_standin.errors import UserError
from ros2_standin.message_text import yaml_text
from ros2_standin.node import find_node, node_names
from ros2_standin.session import Session, add_discovery_arguments, open_session, positive_float

_LABELS = {
    ParameterType.PARAMETER_BOOL: "Boolean value is:",
    ParameterType.PARAMETER_INTEGER: "Integer value is:",
    ParameterType.PARAMETER_DOUBLE: "Double value is:",
    ParameterType.PARAMETER_STRING: "String value is:",
    ParameterType.PARAMETER_BYTE_ARRAY: "Byte values are:",
    ParameterType.PARAMETER_BOOL_ARRAY: "Boolean values are:",
    ParameterType.PARAMETER_INTEGER_ARRAY: "Integer values are:",
    ParameterType.PARAMETER_DOUBLE_ARRAY: "Double values are:",
    ParameterType.PARAMETER_STRING_ARRAY: "String values are:",
}


class _Remote:
    """Parameters of one other node; every call waits for its answer and raises UserError if none comes."""

    def __init__(self, session: Session, name: str, timeout: float) -> None:
        self.name = name
        self._session = session
        self._timeout = timeout
        self._client = AsyncParameterClient(session.node, name)
        if not session.spin_until(self._client.services_are_ready, session.spin_time):
            raise UserError(f"Node '{name}' offers no parameter services")

    def _call(self, future: rclpy.task.Future) -> object:
        return self._session.result(future, self._timeout, f"node '{self.name}'")

    def names(self) -> list[str]:
        return sorted(self._call(self._client.list_parameters()).result.names)

    def values(self, names: list[str]) -> list[ParameterValue]:
        return list(self._call(self._client.get_parameters(names)).values)

    def describe(self, names: list[str]) -> list[ParameterDescriptor]:
        return list(self._call(self._client.describe_parameters(names)).descriptors)

    def set(self, name: str, value: ParameterValue) -> tuple[bool, str]:
        result = self._call(self._client.set_parameters([Parameter(name=name, value=value)])).results[0]
        return result.successful, result.reason


def _plain(value: ParameterValue) -> object:
    found = parameter_value_to_python(value)
    if value.type == ParameterType.PARAMETER_BYTE_ARRAY:
        return [int.from_bytes(item) for item in found]
    return found.tolist() if hasattr(found, "tolist") else found


def _add_common(parser: argparse.ArgumentParser, node: bool = True) -> None:
    add_discovery_arguments(parser)
    if node:
        parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument("--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well")
    parser.add_argument(
        "--timeout", metavar="S", type=positive_float, default=5.0, help="Longest wait for an answer (default: 5)"
    )


def list_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``list``."""
    _add_common(parser, node=False)
    parser.add_argument("node_name", nargs="?", help="Name of the ROS node")
    parser.add_argument("--param-type", action="store_true", help="Print parameter types with parameter names")


def list_verb(args: argparse.Namespace) -> None:
    """Print the names of one node's parameters, or of every node's."""
    with open_session(args) as session:
        if args.node_name:
            nodes = [find_node(session, args.node_name)]
        else:
            session.discover()
            nodes = node_names(session.node, args.include_hidden_nodes)
        for node in nodes:
            try:
                remote = _Remote(session, node, args.timeout)
                names = remote.names()
                kinds = remote.describe(names) if args.param_type else []
            except UserError as error:
                if args.node_name:
                    raise
                print(error, file=sys.stderr)
                continue
            if not args.node_name:
                print(f"{node}:")
            for i, name in enumerate(names):
                print(f"  {name} (type: {_type_name(kinds[i].type)})" if kinds else f"  {name}")


def get_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``get``."""
    _add_common(parser)
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("--hide-type", action="store_true", help="Hide the type information")


def get_verb(args: argparse.Namespace) -> int:
    """Print one value; exit code 1 if it is not set."""
    with open_session(args) as session:
        values = _Remote(session, find_node(session, args.node_name), args.timeout).values([args.parameter_name])
    if not values or values[0].type == ParameterType.PARAMETER_NOT_SET:
        print("Parameter not set", file=sys.stderr)
        return 1
    value = _plain(values[0])
    print(value if args.hide_type else f"{_LABELS[values[0].type]} {value}")
    return 0


def set_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``set``."""
    _add_common(parser)
    parser.add_argument("parameter_name", help="Name of the parameter")
    parser.add_argument("value", help="Value of the parameter, in YAML")


def set_verb(args: argparse.Namespace) -> int:
    """Set one value; exit code 1 if the node refuses it."""
    value = get_parameter_value(args.value)
    with open_session(args) as session:
        remote = _Remote(session, find_node(session, args.node_name), args.timeout)
        successful, reason = remote.set(args.parameter_name, value)
    text = "Set parameter successful" if successful else "Setting parameter failed"
    print(f"{text}: {reason}" if reason else text, file=sys.stdout if successful else sys.stderr)
    return 0 if successful else 1


def dump_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``dump``."""
    _add_common(parser)


def dump_verb(args: argparse.Namespace) -> None:
    """Print all values as a parameter file."""
    with open_session(args) as session:
        remote = _Remote(session, find_node(session, args.node_name), args.timeout)
        names = remote.names()
        values = remote.values(names)
    tree: dict[str, object] = {}
    for name, value in zip(names, values, strict=True):
        if value.type != ParameterType.PARAMETER_NOT_SET:
            *path, leaf = name.split(".")
            place = tree
            for step in path:
                place = place.setdefault(step, {})
            place[leaf] = _plain(value)
    print(yaml_text({remote.name: {"ros__parameters": tree}}), end="")


def describe_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``describe``."""
    _add_common(parser)
    parser.add_argument("parameter_names", nargs="+", help="Names of the parameters")


def describe_verb(args: argparse.Namespace) -> None:
    """Print type, description and constraints."""
    with open_session(args) as session:
        remote = _Remote(session, find_node(session, args.node_name), args.timeout)
        descriptors = remote.describe(args.parameter_names)
    if len(descriptors) != len(args.parameter_names):
        raise UserError(f"Node '{remote.name}' does not know one of {', '.join(args.parameter_names)}")
    for descriptor in descriptors:
        print(_description(descriptor))


def _type_name(kind: int) -> str:
    names = {
        number: name.removeprefix("PARAMETER_").lower().replace("_", " ")
        for name, number in vars(type(ParameterType)).get("_Metaclass_ParameterType__constants", {}).items()
    }
    return names.get(kind, str(kind))


def _description(descriptor: ParameterDescriptor) -> str:
    lines = [f"Parameter name: {descriptor.name}", f"  Type: {_type_name(descriptor.type)}"]
    if descriptor.description:
        lines.append(f"  Description: {descriptor.description}")
    constraints = ["Read only: true"] if descriptor.read_only else []
    for interval in (*descriptor.floating_point_range, *descriptor.integer_range):
        constraints += [f"Min value: {interval.from_value}", f"Max value: {interval.to_value}"]
        if interval.step:
            constraints.append(f"Step: {interval.step}")
    if descriptor.additional_constraints:
        constraints.append(f"Additional constraints: {descriptor.additional_constraints}")
    return "\n".join([*lines, "  Constraints:", *(f"    {line}" for line in constraints)])
