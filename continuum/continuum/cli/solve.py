"""`continuum solve`: inverse kinematics of one target, or of all in a file."""

from __future__ import annotations

import argparse
import json
import math
from typing import Any

import numpy as np

from continuum.arm import Arm, load_arm
from continuum.cli.ik_targets import read_targets, target_of
from continuum.cli.tables import print_table
from continuum.errors import InvalidValueError
from continuum.kinematics.configuration import allen_from_jones, jones_from_allen
from continuum.kinematics.ik_result import IkResult
from continuum.kinematics.ik_target import POSITION
from continuum.kinematics.routing import tangle
from continuum.number_checks import finite_of_shape

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
        parser.add_argument(axis.lower(), metavar=axis, type=float, nargs="?", help="target of the tip [m]")
    parser.add_argument(
        "--direction", metavar=("X", "Y", "Z"), nargs=3, type=float, help="where the tip's z axis shall point"
    )
    parser.add_argument(
        "--quaternion", metavar=("X", "Y", "Z", "W"), nargs=4, type=float, help="the tip's whole orientation"
    )
    parser.add_argument(
        "--targets",
        metavar="FILE",
        help="many targets: lines of x y z, and a direction or a quaternion",
    )
    parser.add_argument(
        "--start", metavar="DEG", nargs="+", type=float, help="bend and azimuth of every section, near which to answer"
    )
    parser.add_argument(
        "--objective",
        choices=("first", "near_start", "least_bending"),
        default="first",
        help="what is done with the freedom that a target leaves; default %(default)s",
    )
    parser.add_argument("--tolerance", type=float, default=1e-6, help="[m] and [rad]; default %(default)g")
    parser.add_argument("--json", action="store_true", help="print a line of JSON for every target, in m and rad")
    parser.set_defaults(run=run, refuse=parser.error)


def run(options: argparse.Namespace) -> int:
    """Solve and print; 1 where a target is not reached."""
    from continuum.kinematics.inverse_kinematics import InverseKinematics  # here: numba takes its time to load

    point = [value for value in (options.x, options.y, options.z) if value is not None]
    if len(point) != (0 if options.targets else 3):
        options.refuse("a target is X Y Z, or there is a file of --targets")
    if not options.tolerance > 0:
        raise InvalidValueError("--tolerance", options.tolerance, "a number > 0 [m] and [rad]")
    arm = load_arm(options.arm)
    targets = read_targets(options.targets) if options.targets else target_of(point, options)
    start = None if options.start is None else _start(arm, options.start)
    solver = InverseKinematics(arm, options.tolerance, options.objective)
    answers = solver.solve_many(targets, None if start is None else [start] * len(targets))
    for k in range(len(targets)):
        if options.json:
            print(json.dumps(_plain(answers[k])))
        else:
            _show(arm, answers[k], targets.kind > POSITION)
    farthest = math.hypot(*targets.positions[int(np.argmax(answers.distances))])
    if not options.json and 10.0 * arm.length < farthest <= 1e3 * arm.length:
        print(f"Targets are in metres, and the arm is {arm.length:.3g} m long: were these millimetres?")
    return 0 if answers.solved.all() else 1


def _start(arm: Arm, degrees: list[float]) -> Any:
    if len(degrees) != 2 * arm.n_sections:
        raise InvalidValueError("--start", degrees, f"bend and azimuth of each of {arm.n_sections} sections [deg]")
    pairs = finite_of_shape("--start", [math.radians(value) for value in degrees], (-1,)).reshape(-1, 2)
    return allen_from_jones(pairs[:, 1], pairs[:, 0])


def _plain(result: IkResult) -> dict[str, object]:
    return {
        "status": result.status.name,
        "distance": result.distance,
        "angle": result.angle,
        "iterations": result.iterations,
        "configuration": result.configuration.tolist(),
    }


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
