"""`continuum solve`: inverse kinematics of one target."""

from __future__ import annotations

import argparse
import math
from typing import Any

import numpy as np

from continuum.arm import Arm, load_arm
from continuum.cli.tables import print_table
from continuum.errors import InvalidValueError
from continuum.kinematics.configuration import jones_from_allen
from continuum.kinematics.ik_result import IkResult
from continuum.kinematics.routing import tangle

_WORDS = {
    "SOLVED": "reached",
    "LIMIT_REACHED": "not reached: a bend limit keeps the arm away",
    "UNREACHABLE": "not reached: out of reach",
    "NO_CONVERGENCE": "not reached: the search ended without an answer",
}


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser("solve", help="bring the tip of an arm to a point", description=__doc__)
    parser.add_argument("arm", metavar="ARM.yaml", help="parameter file of the arm")
    for axis in ("X", "Y", "Z"):
        parser.add_argument(axis.lower(), metavar=axis, type=float, help="target of the tip [m]")
    parser.add_argument(
        "--direction", metavar=("X", "Y", "Z"), nargs=3, type=float, help="where the tip's z axis shall point"
    )
    parser.add_argument("--tolerance", type=float, default=1e-6, help="[m] and [rad]; default %(default)g")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Solve and print; 1 where the target is not reached."""
    from continuum.kinematics.inverse_kinematics import solve  # here: numba takes its time to load

    if not options.tolerance > 0:
        raise InvalidValueError("--tolerance", options.tolerance, "a number > 0 [m] and [rad]")
    arm = load_arm(options.arm)
    direction = None if options.direction is None else np.array(options.direction)
    result = solve(arm, np.array([options.x, options.y, options.z]), direction, tolerance=options.tolerance)
    _show(arm, result, direction is not None)
    return 0 if result.solved else 1


def _show(arm: Arm, result: IkResult, with_direction: bool) -> None:
    angle = f", {math.degrees(result.angle):.3g} degrees off its direction" if with_direction else ""
    print(f"{_WORDS[result.status.name]}; the tip is {1e3 * result.distance:.3g} mm from the target{angle}.")
    phi, theta = jones_from_allen(result.configuration)
    totals = iter(1e3 * tangle(result.configuration, arm))
    rows = [
        (
            section.name,
            f"{math.degrees(theta[i]):.2f}",
            f"{math.degrees(phi[i]):.2f}",
            "  ".join(f"{next(totals):.2f}" for _ in section.cable_azimuths),
        )
        for i, section in enumerate(arm.sections)
    ]
    print_table(("section", "bend theta\n[deg]", "azimuth phi\n[deg]", "total cable lengths\n[mm]"), rows)
