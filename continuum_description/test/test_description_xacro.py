"""The xacro files under the real xacro command: the same robot as the generator's."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from description_model import SHIPPED_ARMS, shipped_name

from continuum.arm import load_arm
from continuum.cli import main
from continuum.urdf.robot import robot_urdf, to_text
from continuum_description import create_continuum_robot

pytestmark = pytest.mark.slow

MINIMAL = "sections: [one, two]\none: {n_joints: 2, b: 0.1, a: 0.05}\ntwo: {n_joints: 3, b: 1, a: 0.5, twist: -1}\n"


def xacro(file: Path, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run the xacro command on a file."""
    command = [sys.executable, "-c", "import xacro; xacro.main()", str(file), *arguments]
    return subprocess.run(
        command, capture_output=True, text=True, timeout=120, env=os.environ | environment, check=False
    )


def canonical(text: str) -> str:
    """The document without comments, white space and the order of attributes."""
    return ElementTree.canonicalize(text, strip_text=True)


@pytest.fixture
def moved_share(tmp_path: Path) -> Path:
    """A copy of the installed files, as colcon lays them out, under a folder with a space in its name."""
    prefix = tmp_path / "a place" / "install"
    share = prefix / "share" / "continuum_description"
    for folder in ("urdf", "config"):
        shutil.copytree(Path(__file__).resolve().parents[1] / folder, share / folder)
    marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / "continuum_description"
    marker.parent.mkdir(parents=True)
    marker.touch()
    return share


def assert_same_robot(result: subprocess.CompletedProcess[str], arm_file: Path) -> None:
    assert (result.returncode, result.stderr) == (0, "")
    assert canonical(result.stdout) == canonical(to_text(robot_urdf(load_arm(arm_file))))


@pytest.mark.parametrize("arm_file", SHIPPED_ARMS, ids=shipped_name)
def test_main_file_reads_shipped_arms(moved_share: Path, arm_file: Path) -> None:
    moved = moved_share / "config" / arm_file.name
    assert_same_robot(xacro(moved_share / "urdf" / "continuum.urdf.xacro", f"arm:={moved}"), arm_file)


def test_main_file_has_the_librarys_defaults_and_reads_a_bare_block(moved_share: Path, tmp_path: Path) -> None:
    arm_file = tmp_path / "my arm.yaml"
    arm_file.write_text(MINIMAL)
    assert_same_robot(xacro(moved_share / "urdf" / "continuum.urdf.xacro", f"arm:={arm_file}"), arm_file)


def test_main_file_takes_other_names_and_leaves_the_block_for_simulations(moved_share: Path, tmp_path: Path) -> None:
    arm_file = tmp_path / "arm.yaml"
    section = "half_spacing: 0.1, hole_radius: 0.05, mass: 0.3, inertia: 1.0e-4, dynamics: {center_of_mass_mm: 1.0}"
    arm_file.write_text(f"sections: [one]\none: {{n_joints: 2, {section}}}\n")
    assert_same_robot(xacro(moved_share / "urdf" / "continuum.urdf.xacro", f"arm:={arm_file}"), arm_file)


def test_main_file_refuses_units_and_names_the_command_that_takes_them(
    moved_share: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arm_file = tmp_path / "arm.yaml"
    assert main(["new-arm", str(arm_file), "--sections", "2"]) == 0
    result = xacro(moved_share / "urdf" / "continuum.urdf.xacro", f"arm:={arm_file}")
    assert result.returncode != 0
    command = "ros2 run continuum_description create_continuum_robot --arm"
    assert command in result.stderr
    assert command in arm_file.read_text()
    capsys.readouterr()
    assert create_continuum_robot.main(["--arm", str(arm_file)]) == 0
    assert canonical(capsys.readouterr().out) == canonical(to_text(robot_urdf(load_arm(arm_file))))


def test_main_file_without_argument_is_the_arm_of_three_sections(moved_share: Path) -> None:
    assert_same_robot(
        xacro(moved_share / "urdf" / "continuum.urdf.xacro"), moved_share / "config" / "three_sections.yaml"
    )


@pytest.mark.parametrize(
    ("written", "wrong"), [("twist: -1", "twits: -1"), ("b: 1,", ""), ("b: 1,", "b: 1, half_spacing: 1,")]
)
def test_main_file_refuses_wrong_names(moved_share: Path, tmp_path: Path, written: str, wrong: str) -> None:
    arm_file = tmp_path / "arm.yaml"
    arm_file.write_text(MINIMAL.replace(written, wrong))
    result = xacro(moved_share / "urdf" / "continuum.urdf.xacro", f"arm:={arm_file}")
    assert result.returncode != 0
    assert "two needs ['n_joints', 'b', 'a'] and may have" in result.stderr


def test_generated_xacro_expands_to_the_generated_urdf(moved_share: Path, tmp_path: Path) -> None:
    arm_file = moved_share / "config" / "published_sections.yaml"
    generated = tmp_path / "robot.urdf.xacro"
    assert create_continuum_robot.main(["--arm", str(arm_file), "--format", "xacro", "-o", str(generated)]) == 0
    prefix = moved_share.parents[1]
    assert_same_robot(xacro(generated, AMENT_PREFIX_PATH=str(prefix)), arm_file)
