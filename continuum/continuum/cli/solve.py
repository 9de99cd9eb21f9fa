"""`continuum solve`: inverse kinematics for one target, or for all targets in a file."""

from __future__ import annotations

import argparse
import json
import math
import sys
from typing import Any

import numpy as np

from continuum.arm import Arm, load_arm
from continuum.arrays import Array
from continuum.cli.completion import completes_files
from continuum.cli.ik_targets import read_targets, target_of
from continuum.cli.tables import print_table
from continuum.errors import InvalidValueError
from continuum.kinematics.configuration import allen_from_jones, jones_from_allen
from continuum.kinematics.ik_result import IkResult
from continuum.kinematics.ik_target import POSITION, Targets
from continuum.kinematics.routing import tangle
from continuum.shipped_files import ARMS

_WORDS = {
    "SOLVED": "reached",
    "LIMIT_REACHED": "not reached: a bend limit keeps the arm away",
    "UNREACHABLE": "not reached: out of reach",
    "NO_CONVERGENCE": "not reached: the search ended without an answer",
}


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser("solve", help="bring the tip of an arm to a point", description=__doc__)
    arm = parser.add_argument(
        "arm", metavar="ARM.yaml", help="parameter file of the arm, or name of an arm in the library"
    )
    completes_files(arm, ARMS)
    for axis in ("X", "Y", "Z"):
        parser.add_argument(axis.lower(), metavar=axis, type=float, nargs="?", help="target of the tip [m]")
    parser.add_argument(
        "--direction", metavar=("X", "Y", "Z"), nargs=3, type=float, help="direction of the tip's z axis"
    )
    parser.add_argument(
        "--quaternion", metavar=("X", "Y", "Z", "W"), nargs=4, type=float, help="orientation of the tip"
    )
    parser.add_argument(
        "--targets",
        metavar="FILE",
        help="many targets: lines of x y z [m], and a direction or a quaternion; a heading x,y,z.. may come first",
    )
    parser.add_argument(
        "--start",
        metavar="DEG",
        nargs="+",
        type=float,
        help="bend and azimuth of every section [degrees], near which to search; default straight",
    )
    parser.add_argument(
        "--objective",
        choices=("first", "near_start", "least_bending"),
        default="near_start",
        help="choice among several solutions: the one nearest to the start, which is the straight arm "
        "unless --start names another, the least bent one, or the first one found; default %(default)s",
    )
    parser.add_argument("--tolerance", type=float, default=1e-6, help="[m] and [rad]; default %(default)g")
    parser.add_argument("--json", action="store_true", help="print a line of JSON for every target, in m and rad")
    parser.set_defaults(run=run, refuse=parser.error)


def run(options: argparse.Namespace) -> int:
    """Solve and print; return 1 if a target is not reached."""
    from continuum.kinematics.inverse_kinematics import InverseKinematics  # imported here because numba is slow to load

    point = [value for value in (options.x, options.y, options.z) if value is not None]
    if len(point) != (0 if options.targets else 3):
        options.refuse("give a target X Y Z, or a file with --targets")
    if options.targets and (options.direction or options.quaternion):
        options.refuse("--direction and --quaternion belong to X Y Z; a file of --targets contains them in its lines")
    if not options.tolerance > 0:
        raise InvalidValueError("--tolerance", options.tolerance, "a number > 0 [m] and [rad]")
    arm = load_arm(options.arm)
    targets = read_targets(options.targets) if options.targets else target_of(point, options)
    start = None if options.start is None else _start(arm, options.start)
    solver = InverseKinematics(arm, options.tolerance, options.objective)
    answers = solver.solve_many(targets, None if start is None else [start] * len(targets))
    for k in range(len(targets)):
        if options.json:
            print(json.dumps(_plain(arm, targets, k, answers[k])))
        else:
            if len(targets) > 1:
                print("\n" * (k > 0) + f"target {k + 1} of {len(targets)}, {_position(targets, k)}:")
            _show(arm, answers[k], targets.kind > POSITION)
    farthest = math.hypot(*targets.positions[int(np.argmax(answers.distances))])
    if not options.json and 10.0 * arm.length < farthest <= 1e3 * arm.length:
        print(f"Targets are in metres, and the arm is {arm.length:.3g} m long: were these millimetres?")
    return 0 if answers.solved.all() else 1


def _position(targets: Targets, k: int) -> str:
    return " ".join(f"{value:g}" for value in targets.positions[k]) + " m"


def _start(arm: Arm, degrees: list[float]) -> Array:
    """Return the configuration (n_sections, 2) [rad] of bends and azimuths [degrees]; warn of bends beyond a limit."""
    if len(degrees) != 2 * arm.n_sections or not all(map(math.isfinite, degrees)):
        allowed = f"finite numbers, bend and azimuth of each of {arm.n_sections} sections [degrees]"
        raise InvalidValueError("--start", degrees, allowed)
    pairs = np.radians(degrees).reshape(-1, 2)
    for section, bend in zip(arm.sections, np.abs(pairs[:, 0]), strict=True):
        if bend > section.bend_limit + 1e-9:
            bent, limit = math.degrees(bend), math.degrees(section.bend_limit)
            print(
                f"continuum: --start bends {section.name} by {bent:g} degrees; its limit is {limit:g}, and the "
                "solution respects it",
                file=sys.stderr,
            )
    return allen_from_jones(pairs[:, 1], pairs[:, 0])


def _plain(arm: Arm, targets: Targets, k: int, result: IkResult) -> dict[str, object]:
    """Return the solution in SI units together with the k-th target."""
    target = {"position": targets.positions[k].tolist()}
    if targets.directions is not None:
        target["direction"] = targets.directions[k].tolist()
    if targets.rotations is not None:
        target["rotation"] = targets.rotations[k].tolist()
    return {
        "target": target,
        "status": result.status.name,
        "distance": result.distance,
        "angle": result.angle,
        "iterations": result.iterations,
        "sections": [section.name for section in arm.sections],
        "configuration": result.configuration.tolist(),
        "cable_lengths": dict(zip(arm.cable_names, tangle(result.configuration, arm).tolist(), strict=True)),
    }


def _show(arm: Arm, result: IkResult, with_direction: bool) -> None:
    angle = f", {math.degrees(result.angle):.3g} degrees off its direction" if with_direction else ""
    print(f"{_WORDS[result.status.name]}; the tip is {1e3 * result.distance:.3g} mm from the target{angle}.")
    phi, theta = jones_from_allen(result.configuration)
    rows = [
        (section.name, f"{math.degrees(theta[i]):.2f}", f"{math.degrees(phi[i]):.2f}")
        for i, section in enumerate(arm.sections)
    ]
    print_table(("section", "bend theta\n[deg]", "azimuth phi\n[deg]"), rows)
    totals = 1e3 * tangle(result.configuration, arm)
    lengths = [(name, f"{total:.2f}") for name, total in zip(arm.cable_names, totals, strict=True)]
    print()
    print_table(("cable", "total length\n[mm]"), lengths)
