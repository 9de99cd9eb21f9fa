"""The shipped arms, the launch file and RViz's configuration."""

import os
import shlex
import subprocess
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml

from continuum.arm import SECTION_PARAMETERS, load_arm
from continuum.dynamics.model_file import load_model
from continuum.dynamics.planar.cable_lengths import cable_lengths as planar_lengths
from continuum.kinematics.cables import cable_lengths
from continuum.kinematics.configuration import allen_from_jones
from continuum.urdf.robot import BASE_LINK

SHARE = Path(__file__).resolve().parents[1]


def test_prototype_writes_table_1_out() -> None:
    written = yaml.safe_load((SHARE / "config" / "prototype.yaml").read_text())["/**"]["ros__parameters"]["arm"]
    section = written["section_1"]
    expected = {spec.name: spec.default for spec in SECTION_PARAMETERS if spec.default is not None}
    expected |= {"n_joints": 5, "a": 0.032, "b": (0.0250 + 0.0135) / 2}
    assert section.keys() == expected.keys()
    for name, value in expected.items():
        assert section[name] == pytest.approx(value, rel=1e-12), name


def test_planar_prototype_has_the_two_cables_of_the_dynamic_model() -> None:
    """It is the prototype but for the numbers of its cables: 1 and 2 are as long as the model has them at any bend."""
    (section,), (whole,) = (
        load_arm(SHARE / "config" / f"{name}.yaml").sections for name in ("planar_prototype", "prototype")
    )
    assert sorted(section.cable_azimuths) == sorted(whole.cable_azimuths)
    assert replace(section, cable_azimuths=whole.cable_azimuths) == whole
    parameters = load_model("lamecc_prototype.yaml").parameters
    for bend in (-1.2, 0.0, 0.7):
        planar = planar_lengths(np.full(section.n_joints, bend / section.n_joints), parameters)
        np.testing.assert_allclose(cable_lengths(allen_from_jones(0.0, bend), section)[:2], planar, rtol=1e-12)


@pytest.fixture
def desktop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stand-ins for the node of the frames and packages that no wheel has, which show their parameter files and end."""
    programs = {name: name for name in ("joint_state_publisher_gui", "rviz2")}
    for package, name in (programs | {"continuum_manipulator": "forward_kinematics"}).items():
        marker = tmp_path / "share" / "ament_index" / "resource_index" / "packages" / package
        program = tmp_path / "lib" / package / name
        for path in (marker, program):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.touch(0o755)
        program.write_text('#!/bin/sh\nfor word; do case "$word" in *.yaml) echo ---; cat "$word";; esac; done\n')
    monkeypatch.setenv("AMENT_PREFIX_PATH", os.pathsep.join([str(tmp_path), os.environ["AMENT_PREFIX_PATH"]]))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))


def launch(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["ros2", "launch", SHARE / "launch" / "display.launch.py", *words], capture_output=True, text=True, check=False
    )


@pytest.mark.usefixtures("desktop")
@pytest.mark.parametrize("rename", [{}, {" b:": " half_spacing:", " a:": " hole_radius:"}], ids=["short", "long"])
def test_launch_file_describes_the_arm_it_is_given_where_paths_have_spaces(tmp_path: Path, rename: dict) -> None:
    """And it ends with an exit code of its own when the publisher ends."""
    arm = tmp_path / "an arm.yaml"
    content = (SHARE / "config" / "published_sections.yaml").read_text()
    for short, long in rename.items():
        content = content.replace(short, long)
    arm.write_text(content)
    result = launch(f"arm:={arm}", "gui:=false", "rviz:=false")
    assert result.returncode == 1
    assert "forward_kinematics ended with exit code 0; the launch requires it" in result.stdout
    assert result.stderr.count("warning: ") == len(result.stderr.splitlines()) == 2  # mass and inertia are left out
    said = [line for line in result.stdout.splitlines() if line.startswith("[forward_kinematics-1]")]
    files = yaml.safe_load_all("\n".join(line.partition("] ")[2] for line in said))
    given = [entry["ros__parameters"] for file in files for entry in file.values()]
    (description,) = (one["robot_description"] for one in given if "robot_description" in one)
    links = {link.get("name") for link in ElementTree.fromstring(description).iter("link")}
    assert {BASE_LINK, "section_3_tip", "section_3_disc_4"} <= links


@pytest.mark.usefixtures("desktop")
def test_launch_file_starts_sliders_and_rviz_with_its_configuration() -> None:
    lines = launch("--print").stdout.splitlines()
    assert [line.partition(":")[0] for line in lines] == [
        "forward_kinematics", "joint_state_publisher_gui", "rviz2",
    ]  # fmt: skip
    alone = launch("gui:=false", "frames:=false", "--print").stdout.splitlines()
    assert [line.partition(":")[0] for line in alone] == ["rviz2"]
    (config,) = (word for word in shlex.split(lines[-1]) if word.endswith(".rviz"))
    assert Path(config).is_file()


def test_rviz_shows_the_topics_of_the_nodes() -> None:
    manager = yaml.safe_load((SHARE / "rviz" / "continuum.rviz").read_text())["Visualization Manager"]
    assert manager["Global Options"]["Fixed Frame"] == BASE_LINK
    topics = {
        (display["Class"].split("/")[1], topic["Value"])
        for display in manager["Displays"]
        if (topic := display.get("Topic", display.get("Description Topic")))
    }
    assert topics == {
        ("RobotModel", "/robot_description"),
        ("MarkerArray", "/cable_markers"),
        ("MarkerArray", "/section_config_markers"),
        ("Pose", "/traj_pose"),
    }
