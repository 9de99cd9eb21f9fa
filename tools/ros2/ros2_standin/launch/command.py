"""``ros2 launch``."""

from __future__ import annotations

import argparse
import asyncio
import dataclasses
from pathlib import Path

from continuum.did_you_mean import did_you_mean
from ros2_standin.errors import UserError
from ros2_standin.launch.launch_file import LaunchFile, ParameterFiles
from ros2_standin.launch.python_api import DeclareLaunchArgument
from ros2_standin.launch.supervisor import supervise
from ros2_standin.packages import package_share


def launch_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``launch``."""
    parser.add_argument("-n", "--noninteractive", action="store_true", help="Changes nothing here: it never asks")
    parser.add_argument(
        "-p",
        "--print",
        "--print-description",
        action="store_true",
        help="Print what would be started, and start nothing",
    )
    parser.add_argument(
        "-s",
        "--show-args",
        "--show-arguments",
        action="store_true",
        help="Show arguments that may be given to the launch file",
    )
    parser.add_argument(
        "-a", "--show-all-subprocesses-output", action="store_true", help="Show all output, whatever the file says"
    )
    parser.add_argument(
        "package_name", help="Name of the ROS package which contains the launch file, or path to a launch file"
    )
    parser.add_argument(
        "words",
        nargs="*",
        metavar="launch_file_name launch_arguments",
        help="Name of the launch file (not after a path), then its arguments: 'name:=value'",
    )


def launch_verb(args: argparse.Namespace) -> int:
    """Evaluate the launch file and run what it asks for."""
    file, words = find_launch_file(args.package_name, args.words)
    given = given_arguments(words)
    with ParameterFiles() as files:
        launch = LaunchFile(files, given, only_arguments=args.show_args)
        launch.read(file)
        if args.show_args:
            print(arguments_text(list(launch.arguments.values())))
            return 0
        for name in given.keys() - launch.arguments.keys():
            raise UserError(f"the launch file has no argument '{name}'{did_you_mean(name, launch.arguments)}")
        processes = launch.processes
        if args.show_all_subprocesses_output:
            processes = [
                dataclasses.replace(process, stdout_to_screen=True, stderr_to_screen=True) for process in processes
            ]
        if args.print:
            print("\n".join(f"{process.name}: {process.line}" for process in processes))
            return 0
        return asyncio.run(supervise(processes, launch.exit_handlers))


def find_launch_file(first: str, words: list[str]) -> tuple[Path, list[str]]:
    """The launch file that the command line names, and the words that are left.

    Args:
        first: a path to a file, or a package.
        words: after a package, its file's name and then the arguments; after a path, the arguments.

    Raises:
        UserError: there is no such file, or several.
    """
    if Path(first).is_file():
        return Path(first), words
    if "/" in first or first.endswith(".py"):
        raise UserError(f"No launch file '{first}'")
    share = package_share(first)
    if not words or ":=" in words[0]:
        names = ", ".join(sorted(path.name for path in share.rglob("*.launch.py"))) or "none"
        raise UserError(f"A launch file name is required after the package; '{first}' has: {names}")
    found = sorted(path for path in share.rglob(words[0]) if path.is_file())
    if len(found) != 1:
        problem = "was not found" if not found else "is there more than once"
        near = did_you_mean(words[0], [path.name for path in share.rglob("*.launch.py")])
        raise UserError(
            f"file '{words[0]}' {problem} in the share directory of package '{first}' which is at '{share}'{near}"
        )
    return found[0], words[1:]


def given_arguments(words: list[str]) -> dict[str, str]:
    """Values of ``name:=value`` words; the last one of a name counts.

    Raises:
        UserError: a word of another form.
    """
    given = {}
    for word in words:
        name, separator, value = word.partition(":=")
        if not separator or not name:
            raise UserError(f"malformed launch argument '{word}', expected format '<name>:=<value>'")
        given[name] = value
    return given


def arguments_text(arguments: list[DeclareLaunchArgument]) -> str:
    """The arguments of a launch file as ``--show-args`` tells them."""
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    for argument in arguments:
        lines += ["", f"    '{argument.name}':", f"        {argument.description or 'no description given'}"]
        if argument.choices:
            lines.append(f"        one of: {', '.join(argument.choices)}")
        if argument.default_value is not None:
            lines.append(f"        (default: '{argument.default_value}')")
    if not arguments:
        lines += ["", "    No arguments."]
    return "\n".join(lines)
