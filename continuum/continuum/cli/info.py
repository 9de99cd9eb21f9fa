"""`continuum info`: what an arm file says, and what it leaves to defaults."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping
from typing import Any, cast

from continuum.arm import DYNAMICS, Arm, arm_block, arm_to_mapping, load_arm
from continuum.cli.completion import completes_files
from continuum.cli.outputs import print_json
from continuum.cli.tables import print_table
from continuum.parameter_file import read_parameter_file
from continuum.shipped_files import ARMS, find_file


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser("info", help="show the geometry of an arm", description=__doc__)
    arm = parser.add_argument("arm", metavar="ARM.yaml", help="parameter file of the arm, or one of the library's")
    completes_files(arm, ARMS)
    parser.add_argument("--json", action="store_true", help="print one line of JSON instead, in m, rad and kg")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print a table of the sections and the defaults that were taken, or JSON."""
    from continuum.dynamics.taken_defaults import in_lines, taken_defaults  # here, so that help need not wait for NumPy

    arm = load_arm(options.arm)
    block = arm_block(options.arm, read_parameter_file(find_file(options.arm, ARMS)))
    models = _models(options.arm, block, arm)
    taken = taken_defaults(block, arm)
    if options.json:
        print_json(_plain(arm) | {"models": list(models), "defaults": [one._asdict() for one in taken]})
        return 0
    _show(arm)
    for name, driven in models.items():
        print(f"dynamic model of {name}: driven by {driven}")
    if taken:
        print("left out, and taken from the defaults:")
    for line in in_lines(taken, arm):
        print(line)
    return 0


def _models(path: str, block: Mapping[str, object], arm: Arm) -> dict[str, str]:
    """What drives the dynamic model of each section that has one.

    Raises:
        InvalidValueError: one of them is not valid.
    """
    from continuum.dynamics.model_file import section_inputs

    names = [one.name for one in arm.sections if DYNAMICS in cast("Mapping[str, object]", block[one.name])]
    return {name: inputs.in_words for name, inputs in section_inputs(find_file(path, ARMS), names).items()}


def _plain(arm: Arm) -> dict[str, object]:
    """All that the file says of the geometry, with defaults, as an arm file has it; and the lengths that follow."""
    return {
        "length": arm.length,
        "section_lengths": {section.name: section.length for section in arm.sections},
        "cables": arm.cable_names,
        "arm": arm_to_mapping(arm),
    }


def summary(arm: Arm) -> str:
    """Number of sections, length and number of cables, in one line."""
    sections = "1 section" if arm.n_sections == 1 else f"{arm.n_sections} sections"
    return f"{sections}, {1e3 * arm.length:.1f} mm long, {len(arm.cable_names)} cables"


def _show(arm: Arm) -> None:
    title = summary(arm)
    headings = (
        "section",
        "joints",
        "length\n[mm]",
        "b\n[mm]",
        "a\n[mm]",
        "twist\n[deg]",
        "cables at\n[deg]",
        "bend limit\n[deg]",
    )
    rows = [
        (
            section.name,
            str(section.n_joints),
            f"{1e3 * section.length:.1f}",
            f"{1e3 * section.b:g}",
            f"{1e3 * section.a:g}",
            _degrees(section.twist),
            " ".join(map(_degrees, section.cable_azimuths)),
            f"{math.degrees(section.bend_limit):.1f}",
        )
        for section in arm.sections
    ]
    print_table(headings, rows, title)


def _degrees(angle: float) -> str:
    return f"{round(math.degrees(angle), 2):g}"
