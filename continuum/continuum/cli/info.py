"""`continuum info`: what an arm file says."""

from __future__ import annotations

import argparse
import math
from typing import Any

from continuum.arm import load_arm
from continuum.cli.tables import print_table
from continuum.dynamics.model_path import model_path


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser("info", help="show the geometry of an arm", description=__doc__)
    parser.add_argument("arm", metavar="ARM.yaml", help="parameter file of the arm")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print a table of the sections."""
    arm = load_arm(model_path(options.arm))  # a model's name is found too, and told to be none of an arm
    sections = "1 section" if arm.n_sections == 1 else f"{arm.n_sections} sections"
    title = f"{sections}, {1e3 * arm.length:.1f} mm long, {len(arm.cable_names)} cables"
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
    return 0


def _degrees(angle: float) -> str:
    return f"{round(math.degrees(angle), 2):g}"
