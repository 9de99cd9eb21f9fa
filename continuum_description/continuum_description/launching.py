"""What the launch files of the workspace share: checked arguments, and nodes without which the launch ends.

For launch files alone: ``launch`` and ``launch_ros`` are there where ``ros2 launch`` is.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.events.process import ProcessExited
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from continuum.arm import Arm, arm_to_mapping
from continuum.did_you_mean import did_you_mean
from continuum.urdf.robot import Sensor, urdf_text

BOOLEANS = ("true", "false", "True", "False")

WINDOWS = ("rviz2", "joint_state_publisher_gui")
"""Processes that may end without ending the launch, with any exit code: some windows end with one when closed."""

MAY_END = ("trajectory_publisher",)
"""Processes that may end normally without ending the launch."""

Parameters = str | dict[str, object]
"""Name of a parameter file, or values by name."""


def argument(name: str, default: str, description: str, choices: Sequence[str] | None = None) -> DeclareLaunchArgument:
    """Return an argument of a launch file."""
    return DeclareLaunchArgument(name, default_value=default, description=description, choices=choices)


def switch(name: str, default: str, description: str) -> DeclareLaunchArgument:
    """Return an argument that is true or false."""
    return argument(name, default, description, BOOLEANS)


def launch_file(
    file: str,
    arguments: Sequence[DeclareLaunchArgument],
    processes: Callable[[Mapping[str, str]], Sequence[Node | ExecuteProcess]],
) -> LaunchDescription:
    """Return what a launch file asks for.

    The launch ends, with an exit code other than 0, if it is given an argument that the file does not have, or if a
    process ends that it requires. For the latter, the stock ``on_exit`` of a node would give the exit code 0.

    Args:
        file: ``__file__`` of the launch file.
        arguments: its arguments.
        processes: returns what is started, from the values of the arguments.
    """

    def checked(context: LaunchContext) -> Sequence[RegisterEventHandler | Node | ExecuteProcess]:
        refuse_unknown(Path(file), [one.name for one in arguments], sys.argv)
        started = processes(context.launch_configurations)
        handlers = [OnProcessExit(target_action=process, on_exit=miss) for process in started]
        return [*map(RegisterEventHandler, handlers), *started]

    return LaunchDescription([*arguments, OpaqueFunction(function=checked)])


def refuse_unknown(file: Path, known: Sequence[str], words: Sequence[str]) -> None:
    """Refuse arguments that a launch file does not have; the stock ``ros2 launch`` takes any.

    They are found among the words of the command line, if these name the file by its path, or by its package and name:
    a file that another one includes, of whatever name, is also given the arguments of that one.

    Raises:
        RuntimeError: an argument is unknown.
    """
    package = file.resolve().parent.parent.name  # share/PACKAGE/launch/FILE, or PACKAGE/launch/FILE of a checkout
    by_name = any(pair in ((package, file.name), (file.parent.parent.name, file.name)) for pair in pairwise(words))
    if not by_name and not any(Path(word).resolve() == file.resolve() for word in words if word.endswith(file.name)):
        return
    for word in words:
        name, separator, _ = word.partition(":=")
        if separator and name not in known:
            hint = did_you_mean(name, known) or f"; known: {', '.join(known)}"
            raise RuntimeError(f"{file.name} has no argument {name!r}{hint}")


def miss(event: ProcessExited, context: LaunchContext) -> None:
    """End the launch when a required process ends."""
    name = event.process_name.rpartition("-")[0]
    if not context.is_shutdown and name not in WINDOWS and (event.returncode != 0 or name not in MAY_END):
        raise RuntimeError(f"{name} ended with exit code {event.returncode}; the launch requires it and ends")


def node(package: str, executable: str, *parameters: Parameters, name: str = "", **others: object) -> Node:
    """Return a node under the name of its executable, unless it has another ``name``."""
    label = name or executable
    return Node(
        package=package, executable=executable, name=label, exec_name=label, output="screen",
        parameters=list(parameters), **others,
    )  # fmt: skip


def frames(arm: Arm, *parameters: Parameters, sensors: Iterable[Sensor] = ()) -> Node:
    """Return the node that publishes the description of the arm and its sensors, and the poses of all links."""
    description = {"arm": arm_to_mapping(arm), "robot_description": text(urdf_text(arm, sensors))}
    return node("continuum_manipulator", "forward_kinematics", description, *parameters)


def rviz(*parameters: Parameters) -> Node:
    """Return RViz with the arm, its frames and markers."""
    config = Path(get_package_share_directory("continuum_description")) / "rviz" / "continuum.rviz"
    return node("rviz2", "rviz2", *parameters, arguments=["-d", str(config)])


def file_of(name: str, package: str) -> str:
    """Return the absolute path of a file, or of the file with this name in the package.

    Raises:
        RuntimeError: neither exists.
    """
    shipped = Path(get_package_share_directory(package)) / "config"
    for path in (Path(name).expanduser().absolute(), shipped / name):
        if path.is_file():
            return str(path)
    names = sorted(path.name for path in shipped.glob("*.yaml"))
    raise RuntimeError(f"{name!r} is not a file; {package} has: {', '.join(names)}{did_you_mean(name, names)}")


def text(value: str) -> ParameterValue:
    """Return a text as a parameter whose type is not guessed."""
    return ParameterValue(value, value_type=str)


def number(given: Mapping[str, str], name: str) -> float:
    """Return the value of an argument as a number.

    Raises:
        RuntimeError: it is not one.
    """
    try:
        return float(given[name])
    except ValueError:
        raise RuntimeError(f"{name} is {given[name]!r}; allowed: a number") from None


def is_true(value: str) -> bool:
    """Return one of `BOOLEANS` as a truth value."""
    return value.lower() == "true"
