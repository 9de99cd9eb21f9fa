"""Command-line tool: one section, from its parameters to xacro that a robot includes, or to a URDF of its own."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from continuum.arm import SECTION_PARAMETERS, Arm, Section
from continuum.parameter_spec import ParameterSpec
from continuum.urdf.robot import BASE_LINK, robot_urdf, robot_xacro, to_text
from continuum_description.command_line import run_tool, tool_parser

_EPILOG = """\
The xacro holds the section alone, to be included where its parent link is made. The URDF makes the parent too.

example, a module of the prototype (Table 1 of the thesis) five times:
  create_continuum_segment --name section_1 --n-joints 5 --b 0.01925 --a 0.032 --output section_1.urdf.xacro
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the tool; returns the exit code."""
    parser = tool_parser(
        "create_continuum_segment", "Write the description of one section.", _EPILOG, ["xacro", "urdf"]
    )
    parser.add_argument("--name", required=True, help="name of the section; prefix of its links and joints")
    parser.add_argument(
        "--parent", default=BASE_LINK, metavar="LINK", help=f"link that it stands on (default: {BASE_LINK})"
    )
    for spec in SECTION_PARAMETERS:
        parser.add_argument(
            f"--{spec.name.replace('_', '-')}",
            type=spec.kind,
            nargs="+" if spec.is_list else None,
            required=spec.default is None,
            default=spec.default,
            metavar=spec.unit.upper().replace(" ", "_") or "N",
            help=_help(spec),
        )
    return run_tool(parser, _description, arguments)


def _help(spec: ParameterSpec) -> str:
    unit = f" [{spec.unit}]" if spec.unit else ""
    default = "" if spec.default is None else f" (default: {spec.default})"
    return f"{spec.description}{unit}{default}"


def _description(options: argparse.Namespace) -> str:
    values = {spec.name: getattr(options, spec.name) for spec in SECTION_PARAMETERS}
    arm = Arm((Section(name=options.name, **values),))
    if options.format == "urdf":
        return to_text(robot_urdf(arm, options.parent))
    return to_text(robot_xacro(arm, options.parent, with_base=False))


if __name__ == "__main__":
    sys.exit(main())
