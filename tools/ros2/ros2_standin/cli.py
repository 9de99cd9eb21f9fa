"""Command line: find the verb, import its module, run it, and convert errors and signals to exit codes."""

from __future__ import annotations

import argparse
import importlib
import os
import signal
import sys
from collections.abc import Callable, Sequence
from types import FrameType

from ros2_standin.commands import COMMANDS, Family, Verb
from ros2_standin.errors import UserError

NOTE = (
    "This is not the stock ros2, but a small stand-in that this workspace's set-up provides for machines without a "
    "ROS 2 installation. It covers run, launch (in part), topic, node, param, service, lifecycle, "
    "interface, bag (rosbag2, MCAP) and pkg, in the stock grammar. A stock ros2 on the PATH has precedence."
)


def main(argv: Sequence[str]) -> int:
    """Run ``ros2 ARGV``.

    Returns:
        The exit code: 0, 1 for an error, 2 for wrong usage or an interrupt (as stock), 143 after SIGTERM.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    signal.signal(signal.SIGTERM, _terminate)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs start with it ignored
    try:
        verb = find_verb(argv)
        own, ros_args = (list(argv), []) if verb is None or verb.passes_arguments else split_ros_args(argv)
        args = build_parser(own).parse_args(own)
        args.ros_args = ros_args
        return args.run_verb(args) or 0
    except UserError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return int(signal.SIGINT)
    except BrokenPipeError:
        # The reader of the output has closed it, as in `ros2 topic echo ... | head`.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _terminate(signum: int, _frame: FrameType | None) -> None:
    sys.exit(128 + signum)


def find_verb(argv: Sequence[str]) -> Verb | None:
    """Return the verb in ``argv``; None without a verb (help, or a mistake that the parser will report)."""
    command = COMMANDS.get(argv[0]) if argv else None
    if isinstance(command, Family):
        return command.verbs.get(argv[1]) if len(argv) > 1 else None
    return command


def split_ros_args(argv: Sequence[str]) -> tuple[list[str], list[str]]:
    """Split a command line into the verb's arguments and the ``--ros-args ... [--]`` ones, flags included."""
    own: list[str] = []
    ros_args: list[str] = []
    inside = False
    for word in argv:
        if word == "--ros-args":
            inside = True
        if inside:
            ros_args.append(word)
        else:
            own.append(word)
        if word == "--":
            inside = False
    return own, ros_args


def build_parser(argv: Sequence[str]) -> argparse.ArgumentParser:
    """Return the parser of the whole command, with arguments only for the verb in ``argv``."""
    parser = argparse.ArgumentParser(
        prog="ros2",
        description=f"ros2 (stand-in of this workspace). {NOTE}",
        epilog="Call `ros2 <command> -h` for more detailed usage.",
    )
    commands = _add_choices(parser, "command")
    for name, command in COMMANDS.items():
        wanted = bool(argv) and argv[0] == name
        sub = commands.add_parser(name, help=command.summary, description=command.summary, epilog=NOTE)
        if isinstance(command, Verb):
            if wanted:
                _add_verb(sub, command)
        else:
            verbs = _add_choices(sub, "verb")
            for verb_name, verb in command.verbs.items():
                leaf = verbs.add_parser(verb_name, help=verb.summary, description=verb.summary, epilog=NOTE)
                if wanted and len(argv) > 1 and argv[1] == verb_name:
                    _add_verb(leaf, verb)
    return parser


def _add_choices(parser: argparse.ArgumentParser, metavar: str) -> argparse._SubParsersAction:
    """Add sub-parsers; without a choice, the command prints the help and ends normally."""

    def show_help(_args: argparse.Namespace) -> int:
        parser.print_help()
        return 0

    parser.set_defaults(run_verb=show_help)
    return parser.add_subparsers(title=f"{metavar}s", metavar=f"<{metavar}>")


def _add_verb(parser: argparse.ArgumentParser, verb: Verb) -> None:
    module = importlib.import_module(f"ros2_standin.{verb.module}")
    add_arguments: Callable[[argparse.ArgumentParser], None] = getattr(module, f"{verb.name}_arguments")
    add_arguments(parser)
    parser.set_defaults(run_verb=getattr(module, f"{verb.name}_verb"))
