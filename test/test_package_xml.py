"""Every `package.xml` uses names that rosdep knows on a stock ROS 2 Jazzy."""

from __future__ import annotations

import os
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = {path.parent.name: path for path in sorted(ROOT.glob("*/package.xml"))}
BINARIES = {"joint_state_publisher_gui", "launch", "launch_ros", "ros2launch", "rviz2", "xacro"}
"""Packages of ROS 2 Jazzy without a wheel here."""


def rosdep_keys() -> set[str]:
    lines = (ROOT / "test" / "rosdep" / "noble_keys.txt").read_text(encoding="utf-8").splitlines()
    return {line for line in lines if not line.startswith("#")}


def ros_packages() -> set[str]:
    """Packages of ROS 2 Jazzy that are installed, by the resource index."""
    prefixes = os.environ["AMENT_PREFIX_PATH"].split(os.pathsep)
    index = "share/ament_index/resource_index/packages"
    return {path.name for prefix in prefixes for path in Path(prefix, index).glob("*")}


def named(package: str) -> set[str]:
    return {str(one.text) for one in ET.parse(PACKAGES[package]).getroot() if one.tag.endswith("depend")}


@pytest.mark.parametrize("package", PACKAGES)
def test_rosdep_and_ros_know_every_name(package: str) -> None:
    assert named(package) - rosdep_keys() - ros_packages() - PACKAGES.keys() - BINARIES == set()


@pytest.mark.parametrize("package", sorted({path.parents[1].name for path in ROOT.glob("*/launch/*")}))
def test_a_package_with_launch_files_declares_what_starts_them(package: str) -> None:
    """`ros2 launch`, what the files import, and the packages of the nodes."""
    needed = {"ros2launch"}
    for path in (ROOT / package / "launch").iterdir():
        text = path.read_text(encoding="utf-8")
        needed |= set(re.findall(r"^(?:from|import) (launch\w*|ament_\w+|continuum\w*)", text, re.MULTILINE))
        needed |= set(re.findall(r"\bnode\(\s*\"(\w+)\"", text))
    assert len(needed) > 3
    assert needed - named(package) == {package} & needed
