"""``ros2 run``: the stand-in's process becomes the program, so that signals and exit code are those of the program."""

from __future__ import annotations

import argparse
import os
import shlex
import sys

from ros2_standin.errors import UserError
from ros2_standin.packages import package_executable


def run_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``run``."""
    parser.add_argument(
        "--prefix", help="Prefix command, which should go before the executable (e.g. gdb -ex run --args)"
    )
    parser.add_argument("package_name", help="Name of the ROS package")
    parser.add_argument("executable_name", help="Name of the executable")
    parser.add_argument("argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable")


def run_verb(args: argparse.Namespace) -> None:
    """Replace this process by the executable."""
    path = package_executable(args.package_name, args.executable_name)
    become([*shlex.split(args.prefix or ""), str(path), *args.argv])


def become(command: list[str]) -> None:
    """Replace this process by ``command``.

    Raises:
        UserError: the program cannot be started.
    """
    sys.stdout.flush()
    try:
        os.execvp(command[0], command)
    except OSError as error:
        raise UserError(f"{command[0]}: {error.strerror}") from error
