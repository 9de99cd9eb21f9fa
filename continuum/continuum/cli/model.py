"""`continuum model`: write the model file of a planar arm, from its values or from a URDF."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from continuum.cli.outputs import announce, check_outputs, write
from continuum.dynamics.parameters import PARAMETERS, Parameter
from continuum.errors import ContinuumError, InvalidValueError
from continuum.printable import one_line
from continuum.whole_file import write_whole

if TYPE_CHECKING:
    from continuum.dynamics.model import NamedJoint

_GIVEN = "given to continuum model new"
_MOST_JOINTS = 1000
_CABLES = ("half_spacing", "hole_radius")
_LENGTHS = ("link_length", "half_spacing")
_ABOUT = ("joint", "center")
_FROM_URDF = (
    "mass", "inertia", "center_of_mass", "link_length", "viscous_friction", "coulomb_friction", "gravity", "hang_angle",
)  # fmt: skip


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser("model", help="write the model file of a planar arm", description=__doc__)
    ways = parser.add_subparsers(title="ways", metavar="WAY", dest="way", required=True)
    _add_new(ways)
    _add_urdf(ways)


def _add_new(ways: Any) -> None:
    new = ways.add_parser(
        "new", help="write it from values; missing ones are asked for",
        description="Write a model file from values: one for all joints, or one for each, as 0.3,0.2. At a terminal, "
        "the command asks for required values that are missing.",
    )  # fmt: skip
    new.add_argument("--joints", metavar="N", help="number of joints")
    new.add_argument(
        "--inputs", choices=("joint_torques", "cables"),
        help="inputs of the arm; default: cables if --half-spacing and --hole-radius are given",
    )  # fmt: skip
    new.add_argument(
        "--inertia-about", choices=_ABOUT, default="center", help="reference point of --inertia; default %(default)s"
    )
    for name, parameter in PARAMETERS.items():
        new.add_argument(f"--{name.replace('_', '-')}", metavar="V", help=_help(parameter).replace("%", "%%"))
    new.add_argument("--out", metavar="MODEL.yaml", required=True, help="the file to write")
    new.set_defaults(run=_new)


def _add_urdf(ways: Any) -> None:
    urdf = ways.add_parser(
        "from-urdf", help="write it from a URDF of a serial arm that moves in one plane",
        description="Write a model file from a URDF: masses, inertias, lengths, damping and friction of one chain of "
        "joints with parallel axes. The relation between the angles of the model and of the URDF is printed, and "
        "written to the file.",
    )  # fmt: skip
    urdf.add_argument("urdf", metavar="ARM.urdf", help="robot description; expand xacro files first")
    urdf.add_argument(
        "--tip", metavar="LINK", help="link whose frame is the tip; default: the last frame fixed to the last link"
    )
    urdf.add_argument(
        "--gravity", metavar="X,Y,Z", default="0,0,-9.81",
        help="acceleration of gravity in the frame of the URDF's root [m/s2]; default %(default)s",
    )  # fmt: skip
    urdf.add_argument("--out", metavar="MODEL.yaml", required=True, help="the file to write")
    urdf.set_defaults(run=_from_urdf)


def _help(parameter: Parameter) -> str:
    text = f"{parameter.meaning} [{parameter.unit}]"
    if parameter.default is not None:
        return f"{text}; default {parameter.default:g}"
    return text if parameter.optional else f"{text}; required"


def _new(options: argparse.Namespace) -> int:
    check_outputs((), [options.out])
    given = {name: text for name in PARAMETERS if (text := getattr(options, name)) is not None}
    if options.joints is not None:
        _whole(options.joints)  # before the command asks for values
    joints, given = _completed(options, given)
    n_joints = _whole(joints)
    values: dict[str, list[float]] = {name: _numbers(name, text) for name, text in given.items()}
    if options.inertia_about == "joint":
        values["inertia"] = _about_centre(n_joints, values)
    inputs = options.inputs or ("cables" if all(name in given for name in _CABLES) else "joint_torques")
    return _write(options.out, n_joints, inputs, values, _GIVEN)


def _from_urdf(options: argparse.Namespace) -> int:
    # Imported here because the URDF reader is slow to load.
    from continuum.dynamics.urdf_chain import chain_from_urdf

    check_outputs([options.urdf], [options.out])
    gravity = _numbers("gravity", options.gravity)
    if len(gravity) != 3:
        raise InvalidValueError("--gravity", options.gravity, "three numbers such as 0,0,-9.81")
    chain = chain_from_urdf(options.urdf, options.tip, gravity)
    named = chain.model.parameters.named()
    values = {name: [float(one) for one in named[name]] for name in _FROM_URDF}
    tip = f"the frame of {chain.tip}" if chain.tip else "twice as far as the last centre of mass: the URDF has no tip"
    lines = [f"tip: {tip}", *(one.in_words(number) for number, one in enumerate(chain.model.joints, 1))]
    return _write(
        options.out, chain.model.n_joints, "joint_torques", values, str(options.urdf), lines, chain.model.joints
    )


def _write(
    path: str,
    n_joints: int,
    inputs: str,
    values: Mapping[str, list[float]],
    source: str,
    lines: Sequence[str] = (),
    joints: tuple[NamedJoint, ...] = (),
) -> int:
    """Write the checked model with comment lines, and print these lines."""
    from continuum.dynamics.commented_model import commented_model
    from continuum.dynamics.model_file import model_from_mapping

    parameters = {
        name: {"value": value, "unit": PARAMETERS[name].unit, "source": source} for name, value in values.items()
    }
    model = model_from_mapping({"n_joints": n_joints, "inputs": inputs, "parameters": parameters})
    model = replace(model, joints=joints)
    write(path, lambda file: write_whole(file, commented_model(model, lines)))
    for line in lines:
        print(one_line(line))
    how_many = "1 joint" if n_joints == 1 else f"{n_joints} joints"
    print(f"{how_many}, driven by {inputs.replace('_', ' ')}")
    announce([path])
    return 0


def _completed(options: argparse.Namespace, given: Mapping[str, str]) -> tuple[str, dict[str, str]]:
    """Return the number of joints and the values; at a terminal, ask for missing required values.

    Raises:
        ContinuumError: a required value is missing and there is no terminal, or the input ended.
    """
    wanted = [name for name, one in PARAMETERS.items() if one.default is None and not one.optional]
    if not any(name in given for name in _LENGTHS):
        wanted.append("link_length")
    missing = {} if options.joints is not None else {"joints": "number of joints"}
    missing |= {name: f"{PARAMETERS[name].meaning} [{PARAMETERS[name].unit}]" for name in wanted if name not in given}
    if missing and not sys.stdin.isatty():  # no user to ask
        names = ", ".join(f"--{name.replace('_', '-')}" for name in missing)
        raise ContinuumError(f"required are {names}; at a terminal, the command asks for them")
    try:
        answers = {name: input(f"{meaning}: ") for name, meaning in missing.items()}
    except EOFError:
        print(file=sys.stderr)  # end the line of the question
        raise ContinuumError("the input ended before every value was given") from None
    return answers.pop("joints", options.joints), {**given, **answers}


def _whole(text: str) -> int:
    """Parse the number of joints."""
    if not text.strip().isdecimal() or not 1 <= len(text.strip()) <= 4 or not 1 <= int(text) <= _MOST_JOINTS:
        raise InvalidValueError("--joints", text, f"a whole number from 1 to {_MOST_JOINTS}")
    return int(text)


def _numbers(name: str, text: str) -> list[float]:
    """Parse numbers separated by commas."""
    try:
        return [float(one) for one in text.split(",")]
    except ValueError as error:
        raise InvalidValueError(f"--{name.replace('_', '-')}", text, "a number, or several such as 0.3,0.2") from error


def _about_centre(joints: int, values: dict[str, list[float]]) -> list[float]:
    """Return inertias about the centres of mass from those about the joints, by the parallel axis theorem [kg m2]."""
    mass, centre, inertia = (
        value * joints if len(value) == 1 else value
        for value in (values["mass"], values["center_of_mass"], values["inertia"])
    )
    if not len(mass) == len(centre) == len(inertia) == joints:
        raise InvalidValueError("--inertia", inertia, f"one number, or {joints}, as for --mass and --center-of-mass")
    found = [i - m * c * c for m, c, i in zip(mass, centre, inertia, strict=True)]
    if min(found) < 0:
        raise InvalidValueError("--inertia", inertia, "at least mass times centre of mass squared, about the joint")
    return found
