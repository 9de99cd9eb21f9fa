"""A model file for people: every parameter with its meaning and its bounds, also those that are left out."""

from __future__ import annotations

from collections.abc import Sequence

import yaml

from continuum.dynamics.model import Model
from continuum.dynamics.model_file import joints_block
from continuum.dynamics.parameters import PARAMETERS, Parameter
from continuum.printable import one_line

_HEAD = """\
# A planar arm of {joints}, from the base to the tip. A value is one number for all joints, or a list.
# Units are checked; deg, mm and g may take the place of rad, m and kg.
# Lines that begin with # are left out: take the # away and put in your value.
"""

_NAMES = """\
# Names of the joints in recordings of messages, from the base; where theta = sign reading + zero, sign and zero too.
"""


def commented_model(model: Model, heading: Sequence[str] = ()) -> str:
    """The text of a file that `load_model` reads.

    Args:
        model: without effects.
        heading: further lines of comment, before the first value.
    """
    n, values = model.n_joints, model.parameters.named()
    lines = [
        _HEAD.format(joints="1 joint" if n == 1 else f"{n} joints") + "".join(f"# {one_line(one)}\n" for one in heading)
    ]
    lines += [f"n_joints: {n}\n", f"inputs: {model.inputs.value}  # cables or joint_torques\n", _NAMES, _names(model)]
    lines.append("parameters:\n")
    for name, parameter in PARAMETERS.items():
        value = values.get(name)
        given = value is not None and (name in model.sources or parameter.default is None)
        shown = [float(one) for one in value] if value is not None else [parameter.default or 0.0]
        single = len(set(shown)) == 1
        entry = {
            "value": shown[0] if single else shown,
            "unit": parameter.unit,
            "source": model.sources.get(name, "not stated"),
        }
        text = yaml.safe_dump({name: entry}, default_flow_style=True, sort_keys=False, width=10**6).strip()[1:-1]
        lines += [f"  # {_explained(parameter)}\n", f"  {text}\n" if given else f"  # {text}\n"]
    return "".join(lines)


def _names(model: Model) -> str:
    """The line of the joints' names, left out where they are not known."""
    if not model.joints:
        return f"# joints: [{', '.join(f'joint_{number}' for number in range(1, model.n_joints + 1))}]\n"
    block = {"joints": joints_block(model.joints)}
    return yaml.safe_dump(block, default_flow_style=None, sort_keys=False, width=10**6)


def _explained(parameter: Parameter) -> str:
    left_out = "" if parameter.default is None else f"; {parameter.default:g} where it is left out"
    bounds = f"{parameter.lower:g} to {parameter.upper:g} {parameter.unit}"
    return f"{parameter.symbol}: {parameter.meaning}; {bounds}{left_out}"
