"""The `continuum` command: one file per subcommand, each with ``add_to(subparsers)`` and a function that runs it."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from continuum.cli.parser import Parser

_DESCRIPTION = """\
Multi-section, cable-driven snake arms: kinematics, dynamics, and what
recordings show of them."""

_NEXT_STEPS = """\
what you can do next:
  continuum info ARM.yaml                 show lengths and bend limits of an arm
  continuum solve ARM.yaml 0.15 0 0.20    bring the tip to a point
  continuum new-arm my_arm.yaml           write the file of your arm
  continuum model new --out MODEL.yaml    write the model file of a planar arm
  continuum view ARM.yaml                 move it in the browser, or a recording
  continuum simulate --release 90 --picture X.png
                                          release an arm bent by 90 degrees
  continuum import-dot 1.csv 2.csv 3.csv 4.csv 5.csv --out run_1.csv ..
                                          compute joint angles from sensor data
  continuum diagnose run_1.csv run_2.csv  find what the simulation gets wrong
  continuum identify run_1.csv run_2.csv --validate 2
                                          identify springs and friction
  continuum curvature run_1.csv --picture X.png
                                          compare bends at rest with two models
  continuum report RECORDING --arm ARM.yaml
                                          report tracking errors and losses

  ros2 launch trajectory_generator arm.launch.py       start the nodes of an arm
  ros2 launch trajectory_generator arm.launch.py trajectory:=helix.yaml
                                          the same, along the thesis's helix
  ros2 launch continuum_manipulator dynamics.launch.py
                                          simulate an arm that tensions pull
  ros2 bag record /cable_states           record the states of cables

ARM.yaml is a file like continuum_description/config/three_sections.yaml; for an
arm of the library its name is enough: continuum info three_sections.
TAB completes what you type: eval "$(register-python-argcomplete continuum)"
Exit codes: 0 done, 1 no solution (target out of reach, simulation failed),
2 wrong usage, file or value; 130 stopped by Ctrl-C; diagnose has more.
"""

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Errors of writing to stdout when it is a file and no space is left."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command and return the exit code of the process; 1 if the reader of its output has closed the pipe."""
    try:
        try:
            return _run(sys.argv[1:] if arguments is None else arguments)
        finally:
            sys.stdout.flush()
    except (KeyboardInterrupt, SystemError, RuntimeError) as error:
        if not _was_interrupted(error):
            raise
        print("continuum: stopped", file=sys.stderr)
        return 130
    except BrokenPipeError:  # the reader, such as `head`, has closed the pipe
        _print_no_more()
        return 1
    except OSError as error:
        if error.errno not in _FULL:
            raise
        _print_no_more()
        print(f"continuum: what is printed cannot be written ({error.strerror})", file=sys.stderr)
        return 2


def _print_no_more() -> None:
    """Discard further output, which Python would otherwise try to write again at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _was_interrupted(error: BaseException | None) -> bool:
    """Return whether an interrupt caused an error: numba makes it a `SystemError`, a held lock a `RuntimeError`."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _run(arguments: list[str]) -> int:
    """Parse and run; slow imports are here, where an interrupt is caught."""
    from continuum.cli.completion import complete
    from continuum.cli.negative_numbers import written_out
    from continuum.errors import ContinuumError

    parser = command_parser()
    complete(parser)
    options = parser.parse_args(written_out(arguments))
    try:
        with _log_on_stderr():
            return int(options.run(options))
    except ContinuumError as error:
        print(f"continuum: {error}", file=sys.stderr)
        return 2


@contextmanager
def _log_on_stderr() -> Iterator[None]:
    """Print log messages of the library, such as that it compiles, one line each."""
    import logging

    logger, handler = logging.getLogger("continuum"), logging.StreamHandler()
    handler.setFormatter(logging.Formatter("continuum: %(message)s"))
    level = logger.level
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    try:
        yield
    finally:
        logger.removeHandler(handler)
        logger.setLevel(level)


def command_parser() -> Parser:
    """Return the parser of the command with all its subcommands."""
    import argparse

    from continuum.cli import (
        curvature,
        diagnose,
        identify,
        import_dot,
        info,
        model,
        new_arm,
        report,
        simulate,
        solve,
        view,
    )
    from continuum.cli.parser import Parser, ShowVersion

    parser = Parser(
        prog="continuum",
        description=_DESCRIPTION,
        epilog=_NEXT_STEPS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action=ShowVersion, nargs=0, help="show the version and exit")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", dest="command", required=True)
    for command in (info, solve, new_arm, model, simulate, import_dot, identify, curvature, diagnose, report, view):
        command.add_to(commands)
    return parser
