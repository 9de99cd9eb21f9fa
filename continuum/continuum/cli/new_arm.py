"""`continuum new-arm`: write an arm file with a comment for every value, for kinematics, nodes and simulations."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

from continuum.arm import arm_from_mapping, prototype_section
from continuum.cli.info import summary
from continuum.cli.outputs import announce, check_outputs, write
from continuum.errors import ContinuumError, FileError, InvalidValueError
from continuum.parameter_keys import common_name
from continuum.whole_file import write_whole

_MOST_SECTIONS = 100
"""Sections of a file: with more, a number is more likely a slip than an arm."""

_AZIMUTHS = (0.0, 180.0, 90.0, 270.0)
"""Azimuths of the cables [deg]: cables 1 and 2 are opposite, as those of a dynamic model are."""

_TWIST = 90.0
"""A quarter turn [deg], shared among the sections, so that no cable runs into the hole of another."""

_BELOW_CONTACT = 0.99
"""Bend limit where discs would meet before half a turn, as a share of the bend at which they do: just short of it."""

_OF_DYNAMICS = ("stiffness", "viscous_friction", "coulomb_friction")


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "new-arm", help="write the arm file of your arm", description=__doc__,
        epilog="If lengths and mass are omitted, the prototype's are used. All sections have the same values; edit the "
        "file to change them.",
    )  # fmt: skip
    parser.add_argument("file", metavar="NAME.yaml", help="the file to write")
    parser.add_argument("--sections", metavar="N", type=int, default=1, help="number of sections; default %(default)s")
    parser.add_argument("--joints", metavar="N", type=int, default=5, help="joints of a section; default %(default)s")
    length = parser.add_mutually_exclusive_group()
    length.add_argument("--link-length", metavar="M", type=float, help="distance from a joint to the next [m]")
    length.add_argument(
        "--half-spacing", metavar="M", type=float, help="from a disc to the next joint [m]: half the link length"
    )
    parser.add_argument("--hole-radius", metavar="M", type=float, help="distance from the axis to the cable holes [m]")
    parser.add_argument("--mass", metavar="KG", type=float, help="mass of a link with its disc [kg]")
    parser.add_argument(
        "--inertia", metavar="KGM2", type=float,
        help="inertia of a link about its centre of mass, across the axis [kg m2]; default: that of a "
        "cylinder with the mass and length of the link, with the holes on its rim",
    )  # fmt: skip
    parser.add_argument("--stiffness", metavar="K", type=float, help="stiffness of a joint's spring [N m/rad]")
    parser.add_argument("--viscous-friction", metavar="V", type=float, help="viscous friction of a joint [N m s/rad]")
    parser.add_argument("--coulomb-friction", metavar="C", type=float, help="Coulomb friction of a joint [N m]")
    parser.add_argument("--force", action="store_true", help="overwrite an existing file")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Check the values, and write the file."""
    # Here, so that the other commands need not wait for NumPy.
    from continuum.arm import DYNAMICS, arm_to_mapping
    from continuum.dynamics.commented_arm import commented_arm
    from continuum.dynamics.model_file import model_of_section

    path = Path(options.file)
    if path.suffix not in (".yaml", ".yml"):
        raise FileError(options.file, "is to be named NAME.yaml")
    check_outputs((), [path])
    if path.exists() and not options.force:
        raise FileError(options.file, "is there already; --force overwrites it")
    if not 1 <= options.sections <= _MOST_SECTIONS:
        raise InvalidValueError("--sections", options.sections, f"a whole number from 1 to {_MOST_SECTIONS}")
    section, remarks = _section(options)
    dynamics = {"center_of_mass": section["half_spacing"]}
    dynamics |= {name: value for name in _OF_DYNAMICS if (value := getattr(options, name)) is not None}
    names = [f"section_{number}" for number in range(1, options.sections + 1)]
    twists = [0.0, *[math.radians(_TWIST / options.sections)] * (options.sections - 1)]
    blocks = {name: {**section, "twist": twist} for name, twist in zip(names, twists, strict=True)}
    try:
        arm = arm_from_mapping({"sections": names, **blocks})
        first = {**arm_to_mapping(arm), names[0]: {**blocks[names[0]], DYNAMICS: dynamics}}
        model_of_section(path, first, names[0])  # whose bounds are narrower
    except InvalidValueError as error:
        raise _of_option(error, options) from None
    write(path, lambda file: write_whole(file, commented_arm(arm, dynamics, remarks)))
    print(summary(arm))
    announce([path])
    return 0


def _section(options: argparse.Namespace) -> tuple[dict[str, Any], dict[str, str]]:
    """Values of every section, in SI units, and remarks on where they come from.

    Raises:
        ContinuumError: some of the lengths and the mass were given, but not all.
    """
    half_spacing = options.half_spacing if options.link_length is None else options.link_length / 2
    given = {"--link-length or --half-spacing": half_spacing, "--hole-radius": options.hole_radius}
    given["--mass"] = options.mass
    missing = [name for name, value in given.items() if value is None]
    section = {"n_joints": options.joints, "cable_azimuths": [math.radians(one) for one in _AZIMUTHS]}
    remarks = {
        "cable_azimuths": "cables 1 and 2 bend the arm in a simulation",
        "center_of_mass": "taken to be in the disc",
    }
    if len(missing) == len(given):
        prototype = prototype_section()
        mass, inertia = prototype.link_mass, prototype.link_inertia
        half_spacing, hole_radius = prototype.b, prototype.a
        remarks |= dict.fromkeys(("half_spacing", "hole_radius", "mass", "inertia"), "the prototype's")
        if options.inertia is not None:
            raise ContinuumError(f"with --inertia, {', '.join(missing)} are required too")
    elif missing:
        raise ContinuumError(f"required too: {', '.join(missing)}; a default would be that of an arm of another size")
    else:
        mass, hole_radius = options.mass, options.hole_radius
        inertia = _rounded(mass * (3 * hole_radius * hole_radius + 4 * half_spacing * half_spacing) / 12)
        remarks["inertia"] = "taken to be that of a cylinder, m (3 r^2 + l^2) / 12"
    if options.inertia is not None:
        inertia = options.inertia
        del remarks["inertia"]
    section |= {"half_spacing": half_spacing, "hole_radius": hole_radius, "mass": mass, "inertia": inertia}
    return section | {"bend_limit": _bend_limit(options.joints, half_spacing, hole_radius)}, remarks


def _bend_limit(n_joints: int, half_spacing: float, hole_radius: float) -> float:
    """Half a turn, or just short of where neighbouring discs meet, to three digits of degrees [rad]."""
    contact = 2 * n_joints * math.degrees(math.atan2(half_spacing, hole_radius))
    return math.radians(180.0 if contact > 180.0 else float(f"{_BELOW_CONTACT * contact:.3g}"))


def _rounded(estimate: float) -> float:
    """An estimate to four digits, of which no more than one is right."""
    return float(f"{estimate:.4g}")


def _of_option(error: InvalidValueError, options: argparse.Namespace) -> InvalidValueError:
    """The error of a value, by the option that it was given with."""
    name = common_name(error.name.rpartition(".")[2])
    if name == "half_spacing" and options.link_length is not None:
        return InvalidValueError("--link-length", options.link_length, f"of its half, {error.allowed}")
    name = {"n_joints": "joints"}.get(name, name)
    if getattr(options, name, None) is None:
        return error
    return InvalidValueError(f"--{name.replace('_', '-')}", getattr(options, name), error.allowed)
