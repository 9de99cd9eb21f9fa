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
  continuum info ARM.yaml                 lengths, cables, bend limits of an arm
  continuum solve ARM.yaml 0.15 0 0.20    bring the tip to a point
  continuum new-arm my_arm.yaml           write the file of your arm
  continuum model new --out MODEL.yaml    write the model file of a planar arm
  continuum view ARM.yaml                 move it in the browser, or a recording
  continuum simulate --release 90 --picture X.png
                                          let go of an arm bent by 90 degrees
  continuum import-dot 1.csv 2.csv 3.csv 4.csv 5.csv --out run_1.csv ..
                                          joint angles of exported sensor data
  continuum diagnose run_1.csv run_2.csv  what the simulation gets wrong and why
  continuum identify run_1.csv run_2.csv --validate 2
                                          springs and friction, with intervals
  continuum curvature run_1.csv --picture X.png
                                          how the arm is bent at rest
  continuum report RECORDING --arm ARM.yaml
                                          tracking error, cable rates and losses

  ros2 launch trajectory_generator arm.launch.py       the nodes of an arm
  ros2 launch trajectory_generator arm.launch.py trajectory:=helix.yaml
                                          the same, following the thesis's helix
  ros2 launch continuum_manipulator dynamics.launch.xml
                                          a simulated arm that tensions pull
  ros2 bag record /cable_states           record what the cables do

ARM.yaml is a file like continuum_description/config/three_sections.yaml; for an
arm that comes with the library its name will do: continuum info three_sections.
TAB completes what you type: eval "$(register-python-argcomplete continuum)"
Exit codes: 0 done, 1 the answer is no (a target out of reach, a simulation that
fails), 2 wrong usage, file or value; 130 stopped by Ctrl-C; diagnose has more.
"""

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Where stdout is a file, and there is no more room for it."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the process's exit code, 1 where nobody reads on."""
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
    except BrokenPipeError:  # whoever read, as `head` does, has seen enough
        _print_no_more()
        return 1
    except OSError as error:
        if error.errno not in _FULL:
            raise
        _print_no_more()
        print(f"continuum: what is printed cannot be written ({error.strerror})", file=sys.stderr)
        return 2


def _print_no_more() -> None:
    """What is still to be printed would be tried again at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _was_interrupted(error: BaseException | None) -> bool:
    """Whether an interrupt is behind an error: numba makes a `SystemError` of one, a lock in use a `RuntimeError`."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _run(arguments: list[str]) -> int:
    """Parse and run; what takes time to import is imported here, where an interrupt is caught."""
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
    """Print what the library logs, such as that it compiles, a line each."""
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
    """The parser of the command with all its subcommands."""
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
