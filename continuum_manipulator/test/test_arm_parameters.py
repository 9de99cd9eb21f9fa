"""The arm of a node's parameter file: by whatever keys the file has it, the node has it by those of the library."""

from pathlib import Path

import pytest
import rclpy
from rclpy.parameter import Parameter

from continuum.arm import arm_to_mapping, load_arm
from continuum.cli import main
from continuum_manipulator.nodekit.checked_node import CheckedNode

pytestmark = pytest.mark.ros


class Plain(CheckedNode):
    NAME = "plain"
    HAS_ARM = True


@pytest.fixture
def arm_file(tmp_path: Path) -> Path:
    """As `continuum new-arm` writes it: other names, degrees, and a block for simulations."""
    file = tmp_path / "an arm.yaml"
    words = (
        "--sections",
        "2",
        "--link-length",
        "0.03",
        "--hole-radius",
        "0.02",
        "--mass",
        "0.03",
        "--stiffness",
        "0.2",
    )
    assert main(["new-arm", str(file), *words]) == 0
    return file


@pytest.fixture
def node(domain, arm_file):
    content = arm_file.read_text()
    assert " half_spacing: 0.015\n" in content
    assert " center_of_mass: 0.015\n" in content
    content = content.replace(" half_spacing: 0.015\n", " half_spacing_mm: 15.0\n")
    arm_file.write_text(content.replace(" center_of_mass: 0.015\n", " center_of_mass_mm: 15.0\n"))
    rclpy.init(args=["--ros-args", "--params-file", str(arm_file)], domain_id=domain)
    node = Plain()
    yield node
    node.destroy_node()
    rclpy.shutdown()


def test_a_node_has_the_arm_of_the_library(node, arm_file):
    arm = load_arm(arm_file)
    assert node.arm == arm
    for name, values in arm_to_mapping(arm).items():
        for key, value in values.items() if name != "sections" else ():
            found = node.get_parameter(f"arm.{name}.{key}").value
            assert (list(found) if isinstance(value, list) else found) == value


def test_no_parameter_is_there_by_two_names_and_none_can_be_changed(node):
    names = {name for name in node.list_parameters([], 0).names if name.startswith("arm.")}
    assert "arm.section_1.dynamics.stiffness" in names
    other_names = ("_deg", "spacing", "spacing_mm", "hole_radius", ".mass", ".inertia")
    assert not {name for name in names if name.endswith(other_names)}
    for name in names:
        (result,) = node.set_parameters([Parameter(name, value=node.get_parameter(name).value)])
        assert not result.successful, name


def test_parameters_are_declared_as_the_tutorial_says(node):
    """Of the section by the first keys of its table, in SI units; of the block `dynamics` as in the file."""
    assert node.get_parameter("arm.section_1.b").value == 0.015
    assert node.get_parameter("arm.section_1.dynamics.center_of_mass_mm").value == 15.0
    assert not node.has_parameter("arm.section_1.dynamics.center_of_mass")
