"""docs/model-files.md says of parameters what the code says, and its example is a model."""

import re
from pathlib import Path

import yaml

from continuum.dynamics.model import InputKind
from continuum.dynamics.model_file import model_from_mapping
from continuum.dynamics.parameters import PARAMETERS, Parameter

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "model-files.md").read_text(encoding="utf-8")


def left_out(p: Parameter) -> str:
    if p.optional:
        return "none"
    return "required" if p.default is None else f"{p.default:g}"


def test_every_parameter_has_a_row_that_is_right() -> None:
    rows = re.findall(r"^\| `(\w+)` \| (.* \| .*) \|$", PAGE.partition("## Parameters")[2], re.MULTILINE)
    assert [name for name, _ in rows] == list(PARAMETERS)
    for name, said in rows:
        p = PARAMETERS[name]
        owner = "each joint" if p.per_joint else "the arm"
        wanted = f"{p.symbol} | {p.unit} | {p.lower:g} to {p.upper:g} | {left_out(p)} | {owner} | {p.meaning}"
        assert said == wanted, name


def test_every_kind_of_input_has_a_row() -> None:
    table = PAGE.partition("## Inputs")[2].partition("## Parameters")[0]
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == ["inputs", *(kind.value for kind in InputKind)]


def test_the_example_is_a_model() -> None:
    (example,) = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    model = model_from_mapping(yaml.safe_load(example))
    assert (model.n_joints, model.inputs) == (2, InputKind.JOINT_TORQUES)
    (entry,) = re.findall(r"`(\{name: .*?\}\})`", PAGE, re.DOTALL)
    (joint,) = model_from_mapping({**yaml.safe_load(example), "joints": ["shoulder", yaml.safe_load(entry)]}).joints[1:]
    assert (joint.name, joint.sign) == ("elbow", -1)
