"""The shipped arms, the launch file and RViz's configuration."""

import re
import shlex
import subprocess
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml
from ament_index_python.packages import get_package_prefix

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


def launch_root() -> ElementTree.Element:
    return ElementTree.parse(SHARE / "launch" / "display.launch.xml").getroot()


def performed(text: str, arm: Path, prefix: Path) -> str:
    """The launch substitutions of the file, performed as launch does: text put in place, nothing quoted."""
    return re.sub(r"\$\(exec-in-pkg (\w+) (\w+)\)", rf"{prefix}/lib/\2/\1", text).replace("$(var arm)", str(arm))


@pytest.mark.parametrize("rename", [{}, {" b:": " half_spacing:", " a:": " hole_radius:"}], ids=["short", "long"])
def test_launch_file_describes_the_arm_it_is_given_where_paths_have_spaces(tmp_path: Path, rename: dict) -> None:
    prefix = tmp_path / "an install"
    prefix.symlink_to(get_package_prefix("continuum_description"))
    arm = tmp_path / "an arm.yaml"
    content = (SHARE / "config" / "published_sections.yaml").read_text()
    for short, long in rename.items():
        content = content.replace(short, long)
    arm.write_text(content)
    parameter = launch_root().find("node[@exec='robot_state_publisher']/param[@name='robot_description']")
    command, on_stderr = re.fullmatch(r"\$\(command '(.*)' '(\w+)'\)", parameter.get("value")).groups()
    assert on_stderr == "warn"  # by default, a line there ends the launch
    result = subprocess.run(
        shlex.split(performed(command, arm, prefix)), capture_output=True, text=True, timeout=120, check=False
    )
    assert result.returncode == 0
    assert result.stderr.count("warning: ") == len(result.stderr.splitlines()) == 2  # mass and inertia are left out
    links = {link.get("name") for link in ElementTree.fromstring(result.stdout).iter("link")}
    assert {BASE_LINK, "section_3_tip", "section_3_disc_4"} <= links


def test_launch_file_names_arguments_it_has_and_files_that_exist() -> None:
    root = launch_root()
    declared = {argument.get("name") for argument in root.iter("arg")}
    text = (SHARE / "launch" / "display.launch.xml").read_text()
    assert declared == set(re.findall(r"\$\(var (\w+)\)", text)) == {"arm", "gui", "rviz", "use_sim_time"}
    named = re.findall(r"\$\(find-pkg-share continuum_description\)/([\w./]+)", text)
    assert [file for file in named if (SHARE / file).is_file()] == named != []


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
