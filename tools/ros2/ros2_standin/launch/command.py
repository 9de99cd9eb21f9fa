"""``ros2 launch``."""

from __future__ import annotations

import argparse
import asyncio
import dataclasses
from pathlib import Path

from ros2_standin.errors import UserError
from ros2_standin.launch.argument import Argument
from ros2_standin.launch.interpreter import Interpreter
from ros2_standin.launch.parameter_values import ParameterFiles
from ros2_standin.launch.processes import LogLine
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
        interpreter = Interpreter(files, given, only_arguments=args.show_args)
        interpreter.run(file)
        if args.show_args:
            print(arguments_text(list(interpreter.arguments.values())))
            return 0
        steps = interpreter.steps
        if args.show_all_subprocesses_output:
            shown = {"stdout_to_screen": True, "stderr_to_screen": True}
            steps = [step if isinstance(step, LogLine) else dataclasses.replace(step, **shown) for step in steps]
        if args.print:
            print("\n".join(step.text if isinstance(step, LogLine) else f"{step.name}: {step.line}" for step in steps))
            return 0
        for name in given.keys() - interpreter.arguments.keys():
            steps.insert(0, LogLine("warning", f"the launch file has no argument '{name}'"))
        return asyncio.run(supervise(steps, interpreter.exit_handlers))


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
    if "/" in first or first.endswith((".xml", ".py")):
        raise UserError(f"No launch file '{first}'")
    share = package_share(first)
    if not words or ":=" in words[0]:
        files = [path.name for path in share.rglob("*.launch.*") if path.suffix in (".xml", ".py")]
        names = ", ".join(sorted(files)) or "none"
        raise UserError(f"A launch file name is required after the package; '{first}' has: {names}")
    found = sorted(path for path in share.rglob(words[0]) if path.is_file())
    if len(found) != 1:
        problem = "was not found" if not found else "is there more than once"
        raise UserError(
            f"file '{words[0]}' {problem} in the share directory of package '{first}' which is at '{share}'"
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


def arguments_text(arguments: list[Argument]) -> str:
    """The arguments of a launch file as ``--show-args`` tells them."""
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    for argument in arguments:
        lines += ["", f"    '{argument.name}':", f"        {argument.description or 'no description given'}"]
        if argument.choices:
            lines.append(f"        one of: {', '.join(argument.choices)}")
        if argument.default is not None:
            lines.append(f"        (default: '{argument.default}')")
    if not arguments:
        lines += ["", "    No arguments."]
    return "\n".join(lines)
