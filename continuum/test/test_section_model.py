"""The dynamic model in an arm file: the section's geometry is the model's, and what a simulation needs is given."""

import copy
import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from command_line import Captured, refused
from continuum_laws.strategies import LAW, arms, sections
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import Arm, Section, load_arm
from continuum.dynamics.commented_arm import commented_arm
from continuum.dynamics.model import InputKind
from continuum.dynamics.model_file import load_model, model_from_mapping
from continuum.dynamics.parameters import PARAMETERS
from continuum.dynamics.planar.cable_lengths import cable_lengths as planar_cable_lengths
from continuum.errors import FileError, InvalidValueError
from continuum.kinematics.cables import cable_lengths
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.section import section_position

OPPOSITE = (0.0, math.pi, math.pi / 2, 3 * math.pi / 2)
DYNAMICS = {"center_of_mass": 0.01, "stiffness": 0.3}
BLOCK = {
    "n_joints": 3, "half_spacing": 0.015, "hole_radius": 0.02, "mass": 0.03, "inertia": 5e-6,
    "cable_azimuths": list(OPPOSITE),
}  # fmt: skip


def write(folder: Path, block: Mapping[str, object], name: str = "s") -> Path:
    file = folder / "arm.yaml"
    file.write_text(yaml.safe_dump({"arm": {"sections": [name], name: dict(block)}}, sort_keys=False), encoding="utf-8")
    return file


def refusal(folder: Path, block: Mapping[str, object]) -> InvalidValueError:
    with pytest.raises(InvalidValueError) as caught:
        load_model(write(folder, block))
    caught.value.name = caught.value.name.removeprefix(f"{folder / 'arm.yaml'}: ")
    return caught.value


@pytest.fixture(scope="session")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("arms")


@LAW
@given(section=sections(), turned=st.floats(-3.0, 3.0), bends=st.floats(-0.9, 0.9))
def test_kinematics_and_dynamics_of_one_file_agree(
    scratch: Path, section: Section, turned: float, bends: float
) -> None:
    """Straight and bent: length, tip, and the two cables, wherever on the rim they are."""
    azimuths = tuple(math.remainder(one + turned, 2 * math.pi) for one in OPPOSITE)
    file = scratch / "one.yaml"
    arm = Arm((replace(section, cable_azimuths=azimuths),))
    file.write_text(commented_arm(arm, {"center_of_mass": 0.01}, {}), encoding="utf-8")
    (section,), p = load_arm(file).sections, load_model(file).parameters
    n, bend = section.n_joints, bends * section.bend_limit
    assert p.mount[0] + p.joint_spacing[:-1].sum() + p.tip[0] == pytest.approx(section.length, rel=1e-12)
    for theta in (0.0, bend):
        directions = theta / n * np.arange(n + 1)  # of the base plate and of each link
        spacing = np.concatenate([p.mount, p.joint_spacing[:-1], p.tip])
        tip = [np.sum(spacing * np.sin(directions)), np.sum(spacing * np.cos(directions))]
        w = allen_from_jones(azimuths[0], theta)
        x, y, z = section_position(w, section)
        in_plane = x * math.cos(azimuths[0]) + y * math.sin(azimuths[0])
        np.testing.assert_allclose([in_plane, z], tip, atol=1e-9 * section.length)
        lengths = planar_cable_lengths(np.full(n, theta / n), p)
        np.testing.assert_allclose(cable_lengths(w, section)[:2], lengths, rtol=1e-9)


@LAW
@given(arm=arms(), values=st.fixed_dictionaries({"center_of_mass": st.floats(-0.1, 0.1), "gravity": st.floats(0, 20)}))
def test_a_commented_arm_is_read_back(scratch: Path, arm: Arm, values: dict[str, float]) -> None:
    file = scratch / "commented.yaml"
    sections = [replace(one, cable_azimuths=(*OPPOSITE[:2], 1.0)) for one in arm.sections]
    for written in (arm, Arm(tuple(sections))):
        file.write_text(commented_arm(written, values, {"mass": "of a\nscale # 1"}), encoding="utf-8")
        assert load_arm(file) == written
    for section in sections:
        found = load_model(file, section.name)
        expected = {"half_spacing": section.b, "hole_radius": section.a, "mass": section.link_mass, **values}
        assert found.n_joints == section.n_joints
        assert {name: found.values()[name][0] for name in expected} == expected


def test_a_file_of_both_is_the_model_of_a_model_file(tmp_path: Path) -> None:
    """Also with a value for each joint, entries with sources, and effects."""
    entries: dict[str, object] = {
        "stiffness": {"value": [0.1, 0.2, 0.3], "unit": "N m/rad", "source": "weighed"},
        "hang_angle": {"value": math.pi / 2, "unit": "rad"},
        "center_of_mass": {"value": 0.01, "unit": "m"},
    }
    effects = {"tip_payload": {"mass": {"value": 0.05, "unit": "kg", "source": "weighed"}}}
    of_section = {name: {"value": BLOCK[name], "unit": PARAMETERS[name].unit} for name in list(BLOCK)[1:5]}
    expected = model_from_mapping({"n_joints": 3, "parameters": of_section | entries, "effects": effects})
    blocks: list[dict[str, object]] = [
        entries,
        {"stiffness": [0.1, 0.2, 0.3], "hang_angle_deg": 90, "center_of_mass_mm": 10},
    ]
    for block in blocks:
        found = load_model(write(tmp_path, {**BLOCK, "dynamics": block | {"effects": effects}}))
        assert found.inputs is InputKind.CABLES
        assert found.values().keys() == expected.values().keys()
        for name, value in expected.values().items():
            np.testing.assert_array_equal(found.values()[name], value, err_msg=name)
    assert load_model(write(tmp_path, {**BLOCK, "dynamics": entries})).sources["stiffness"] == "weighed"


@pytest.mark.parametrize("wrapped", [False, True])
def test_what_the_kinematics_reads_does_not_depend_on_the_dynamics(tmp_path: Path, wrapped: bool) -> None:
    bare, both = (load_arm(write(tmp_path, BLOCK | more)) for more in ({}, {"dynamics": DYNAMICS}))
    assert bare == both
    content = yaml.safe_load((tmp_path / "arm.yaml").read_text())
    (tmp_path / "arm.yaml").write_text(yaml.safe_dump({"/**": {"ros__parameters": content}} if wrapped else content))
    assert load_model(tmp_path / "arm.yaml").n_joints == 3


@pytest.mark.parametrize("name", ["mass", "inertia"])
def test_a_simulation_takes_no_mass_of_another_arm(tmp_path: Path, name: str) -> None:
    block = {key: value for key, value in BLOCK.items() if key != name} | {"dynamics": DYNAMICS}
    load_arm(write(tmp_path, block))
    assert refusal(tmp_path, block).name == f"arm.s.{name}"


@pytest.mark.parametrize(
    ("dynamics", "name"),
    [
        ({}, "center_of_mass"),
        ({**DYNAMICS, "stifness": 1.0}, "stifness"),
        ({**DYNAMICS, "stiffness": -1.0}, "stiffness"),
        ({**DYNAMICS, "stiffness": [1.0, 2.0]}, "stiffness"),
        ({**DYNAMICS, "stiffness": {"value": 1.0, "unit": "N"}}, "stiffness.unit"),
        ({**DYNAMICS, "hang_angle_deg": 200}, "hang_angle_deg"),
        ({**DYNAMICS, "hang_angle_deg": 20, "hang_angle": 0.1}, "hang_angle"),
        ({**DYNAMICS, "inputs": "wind"}, "inputs"),
        *(({**DYNAMICS, name: 0.1}, name) for name in ("mass", "link_mass", "b", "half_spacing", "link_length")),
        ({**DYNAMICS, "n_joints": 3}, "n_joints"),
        ({**DYNAMICS, "effects": {"tip_payload": {"mass": 0.1}}}, "effects.tip_payload.mass"),
    ],
)
def test_a_bad_block_is_refused_by_the_key_in_the_file(tmp_path: Path, dynamics: dict[str, object], name: str) -> None:
    assert refusal(tmp_path, {**BLOCK, "dynamics": dynamics}).name == f"arm.s.dynamics.{name}"


@pytest.mark.parametrize("wrong", [5, None, [1.0], "text"])
def test_a_block_that_is_none_is_refused_by_both(tmp_path: Path, wrong: object) -> None:
    file = write(tmp_path, {**BLOCK, "dynamics": wrong})
    for load in (load_arm, load_model):
        with pytest.raises(InvalidValueError, match=r"arm\.s\.dynamics is "):
            load(file)


def test_an_arm_without_the_block_is_no_model(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"is an arm file.*block `dynamics:`"):
        load_model(write(tmp_path, BLOCK))


@pytest.mark.parametrize("azimuths", [[0.0, 1.6, 3.2, 4.7], [0.0, 2.1, 4.2]])
def test_cables_that_do_not_bend_it_in_a_plane_are_refused(tmp_path: Path, azimuths: list[float]) -> None:
    block = {**BLOCK, "cable_azimuths": azimuths, "dynamics": DYNAMICS}
    assert refusal(tmp_path, block).name == "arm.s.cable_azimuths"
    block["dynamics"] = DYNAMICS | {"inputs": "joint_torques"}
    assert load_model(write(tmp_path, block)).inputs is InputKind.JOINT_TORQUES


def test_of_several_sections_one_is_named(tmp_path: Path, capsys: Captured) -> None:
    content: dict[str, object] = {"sections": ["s", "t", "u"]}
    for number, name in enumerate(("s", "t", "u"), 1):
        content[name] = {
            **copy.deepcopy(BLOCK),
            "n_joints": number,
            "bend_limit": 1.0,
            **({"dynamics": dict(DYNAMICS)} if name != "u" else {}),
        }
    (tmp_path / "arm.yaml").write_text(yaml.safe_dump(content), encoding="utf-8")
    assert [load_model(tmp_path / "arm.yaml", name).n_joints for name in ("s", "t")] == [1, 2]
    for name in (None, "v"):
        with pytest.raises(InvalidValueError, match="s or t or u"):
            load_model(tmp_path / "arm.yaml", name)
    with pytest.raises(InvalidValueError, match=r"arm\.u\.dynamics is None"):
        load_model(tmp_path / "arm.yaml", "u")
    assert "arm.u.dynamics is None" in refused(capsys, "simulate", "--model", tmp_path / "arm.yaml")
    for words in (["diagnose", "run.csv"], ["simulate", "--section", "v"]):
        line = refused(capsys, *words, "--model", tmp_path / "arm.yaml")
        assert "--section" in line
        assert "s or t or u" in line
        assert "None" not in line
