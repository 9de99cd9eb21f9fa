"""The command-line tools: what they write, and how they refuse."""

from pathlib import Path
from xml.etree import ElementTree

import pytest
from description_model import SHIPPED_ARMS
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum.arm import SECTION_PARAMETERS, Arm, Section, load_arm
from continuum.cli import main
from continuum.errors import InvalidValueError
from continuum.urdf.robot import robot_urdf, to_text
from continuum_description import create_continuum_robot, create_continuum_segment

MODULE = ["--name", "section_1", "--n-joints", "3", "--b", "0.01925", "--a", "0.032"]
THREE_JOINTS = Section("section_1", n_joints=3, b=0.01925, a=0.032, bend_limit=1.5)


def refusal(capsys: pytest.CaptureFixture[str], tool: object, arguments: list[str]) -> str:
    """The one line that the tool says, after a check that it ends with 2 and writes nothing else."""
    try:
        code = tool.main(arguments)
    except SystemExit as leave:
        code = leave.code
    out, err = capsys.readouterr()
    assert (code, out, err.count("\n")) == (2, "", 1), err
    return err


def test_the_arm_file_is_not_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arm = tmp_path / "arm.yaml"
    arm.write_bytes(SHIPPED_ARMS[0].read_bytes())
    line = refusal(capsys, create_continuum_robot, ["--arm", str(arm), "--output", str(arm)])
    assert "is read, and would be overwritten" in line
    assert arm.read_bytes() == SHIPPED_ARMS[0].read_bytes()


def test_robot_writes_the_same_to_file_and_standard_output(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "with space" / "arm.urdf"
    target.parent.mkdir()
    arguments = ["--arm", str(SHIPPED_ARMS[0])]
    assert create_continuum_robot.main([*arguments, "--output", str(target)]) == 0
    assert capsys.readouterr().out == ""
    assert create_continuum_robot.main(arguments) == 0
    assert target.read_text() == capsys.readouterr().out == to_text(robot_urdf(load_arm(SHIPPED_ARMS[0])))


@pytest.mark.parametrize(
    ("section", "warned"),
    [
        ("b: 0.005, a: 0.032", ["mass", "inertia"]),
        ("b: 0.005, a: 0.032, mass: 0.01", ["inertia"]),
        ("b: 0.005, a: 0.032, mass_g: 10, link_inertia: 1.0e-6", []),
        ("b: 0.01925, a: 0.032", []),
    ],
)
def test_robot_warns_of_masses_of_the_prototype_in_links_of_another_size(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], section: str, warned: list[str]
) -> None:
    """With the lines of `continuum info`; the description is written all the same."""
    arm = tmp_path / "arm.yaml"
    arm.write_text(f"sections: [s]\ns: {{n_joints: 3, bend_limit: 0.9, {section}}}\n")
    assert create_continuum_robot.main(["--arm", str(arm)]) == 0
    out, err = capsys.readouterr()
    assert out == to_text(robot_urdf(load_arm(arm)))
    assert [line.split("warning: ")[1].split(":")[0] for line in err.splitlines()] == warned
    assert main(["info", str(arm)]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert all(line.removeprefix("create_continuum_robot: ") in shown for line in err.splitlines())


def test_segment_writes_a_urdf_on_the_named_parent(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = [*MODULE, "--bend-limit", "1.5", "--parent", "table", "--format", "urdf"]
    assert create_continuum_segment.main(arguments) == 0
    assert capsys.readouterr().out == to_text(robot_urdf(Arm((THREE_JOINTS,)), "table"))


def test_segment_passes_every_parameter_to_the_macro(capsys: pytest.CaptureFixture[str]) -> None:
    given_values = {
        "twist": "0.25", "bend_limit": "1.125", "link_mass": "0.5", "link_inertia": "0.0625",
    }  # fmt: skip
    options = [word for name, value in given_values.items() for word in (f"--{name.replace('_', '-')}", value)]
    assert create_continuum_segment.main([*MODULE, *options, "--cable-azimuths", "0", "2", "4"]) == 0
    robot = ElementTree.fromstring(capsys.readouterr().out)
    calls = [element for element in robot if element.tag.endswith("}continuum_segment")]
    assert [element.tag for element in robot if element not in calls] == ["{http://www.ros.org/wiki/xacro}include"]
    assert len(calls) == 1
    expected = given_values | {
        "name": "section_1", "parent": "base_link", "index": "0", "n_joints": "3", "b": "0.01925", "a": "0.032",
        "cable_azimuths": "${[0.0, 2.0, 4.0]}",
    }  # fmt: skip
    assert calls[0].attrib == expected


def test_help_says_every_unit(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as leave:
        create_continuum_segment.main(["--help"])
    assert leave.value.code == 0
    text = " ".join(capsys.readouterr().out.split())
    for spec in SECTION_PARAMETERS:
        assert f"{spec.description} [{spec.unit}]" in text if spec.unit else spec.description in text


@pytest.mark.parametrize(
    ("wrong", "output"),
    [
        (["--a", "-0.032"], "section_1.a is -0.032"),
        (["--b", "wide"], "--b"),
        (["--n-joints", "2.5"], "--n-joints"),
        (["--cable-azimuths", "0", "1"], "section_1.cable_azimuths"),
        (["--name", "the arm"], "name of section is 'the arm'"),
        (["--parent", "${1}"], "parent is '${1}'"),
        (["--output", "/nowhere/at/all.xacro"], "/nowhere/at/all.xacro"),
        (["--format", "sdf"], "--format"),
        (["--length", "3"], "--length"),
    ],
)
def test_segment_refuses_in_one_line(capsys: pytest.CaptureFixture[str], wrong: list[str], output: str) -> None:
    line = refusal(capsys, create_continuum_segment, [*MODULE, *wrong])
    assert line.startswith("create_continuum_segment: ")
    assert output in line


def test_robot_refuses_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wrong = tmp_path / "arm.yaml"
    wrong.write_text("sections: [one]\none: {n_joints: 5, b: 0.02, a: 0.0}\n")
    assert "arm.one.a is 0.0" in refusal(capsys, create_continuum_robot, ["--arm", str(wrong)])
    assert "nowhere.yaml" in refusal(capsys, create_continuum_robot, ["--arm", str(tmp_path / "nowhere.yaml")])
    assert "--arm" in refusal(capsys, create_continuum_robot, [])


@settings(max_examples=60, deadline=None)
@given(
    st.text(max_size=8) | st.sampled_from(["true", "False", "inf", "nan", "Infinity", "e5", "_", "a" * 9, "ñ", "x\n"])
)
def test_a_name_is_refused_or_kept_to_the_letter(name: str) -> None:
    try:
        robot = robot_urdf(Arm((Section(name, n_joints=1, b=0.02, a=0.03, bend_limit=1.0),)))
    except InvalidValueError:
        assert not name.isidentifier() or not name.isascii() or name.startswith("_") or name.lower() in {
            "true", "false", "inf", "infinity", "nan",
        }  # fmt: skip
    else:
        assert f"{name}_tip" in {link.get("name") for link in robot.iter("link")}
