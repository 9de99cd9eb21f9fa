"""`continuum info`: what an arm file says."""

from __future__ import annotations

import argparse
import math
from typing import Any

from rich.console import Console
from rich.table import Table

from continuum.arm import load_arm


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser("info", help="show the geometry of an arm", description=__doc__)
    parser.add_argument("arm", metavar="ARM.yaml", help="parameter file of the arm")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print a table of the sections."""
    arm = load_arm(options.arm)
    table = Table(title=f"{arm.n_sections} sections, {1e3 * arm.length:.1f} mm long, {len(arm.cable_names)} cables")
    for heading in (
        "section",
        "joints",
        "length [mm]",
        "b [mm]",
        "a [mm]",
        "twist [deg]",
        "cables at [deg]",
        "bend limit [deg]",
    ):
        table.add_column(heading, justify="left" if heading == "section" else "right")
    for section in arm.sections:
        table.add_row(
            section.name,
            str(section.n_joints),
            f"{1e3 * section.length:.1f}",
            f"{1e3 * section.b:g}",
            f"{1e3 * section.a:g}",
            f"{math.degrees(section.twist):g}",
            " ".join(f"{math.degrees(azimuth):g}" for azimuth in section.cable_azimuths),
            f"{math.degrees(section.bend_limit):.1f}",
        )
    Console().print(table)
    return 0
