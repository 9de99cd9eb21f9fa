"""Command-line tool: a robot of several sections, from its parameter file to URDF or xacro."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from continuum.arm import arm_block, load_arm
from continuum.dynamics.taken_defaults import taken_defaults, warnings
from continuum.parameter_file import read_parameter_file
from continuum.shipped_files import ARMS, find_file
from continuum.urdf.robot import robot_urdf, robot_xacro, to_text
from continuum_description.command_line import run_tool, tool_parser

_EPILOG = """\
The parameter file is the one that the nodes read, e.g. config/three_sections.yaml of this package. Lengths are in m,
angles in rad, masses in kg, inertias in kg m2; every section may have its own.

example:
  create_continuum_robot --arm three_sections.yaml --output three_sections.urdf
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the tool; returns the exit code."""
    parser = tool_parser(
        "create_continuum_robot", "Write the description of an arm of several sections.", _EPILOG, ["urdf", "xacro"]
    )
    parser.add_argument("--arm", metavar="FILE", type=Path, required=True, help="the arm's parameter file (YAML)")
    return run_tool(parser, _description, arguments, lambda options: [options.arm])


def _description(options: argparse.Namespace) -> str:
    arm = load_arm(options.arm)
    block = arm_block(options.arm, read_parameter_file(find_file(options.arm, ARMS)))
    for line in warnings(taken_defaults(block, arm)):
        print(f"create_continuum_robot: {line}", file=sys.stderr)
    return to_text(robot_urdf(arm) if options.format == "urdf" else robot_xacro(arm))


if __name__ == "__main__":
    sys.exit(main())
