"""Every `package.xml` names what its package imports, by names that rosdep knows on a stock ROS 2 Jazzy."""

from __future__ import annotations

import ast
import os
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = {path.parent.name: path for path in sorted(ROOT.glob("*/package.xml"))}
KEY_OF = {
    "casadi": "casadi-pip",
    "jinja2": "python3-jinja2",
    "matplotlib": "python3-matplotlib",
    "numba": "python3-numba",
    "llvmlite": "python3-numba",
    "numpy": "python3-numpy",
    "rich": "python3-rich",
    "rosbags": "python3-rosbags-pip",
    "scipy": "python3-scipy",
    "serial": "python3-serial",
    "trimesh": "python3-trimesh-pip",
    "yaml": "python3-yaml",
    "yourdfpy": "python3-yourdfpy-pip",
}
"""Keys of modules whose package has another name; others have their own."""
WITHOUT_KEY = {"viser"}
"""Modules that rosdep does not know; docs/dependencies.md says how to install them."""
BINARIES = {"joint_state_publisher_gui", "robot_state_publisher", "rviz2", "xacro"}
"""Packages of ROS 2 Jazzy without a wheel here."""


def rosdep_keys() -> set[str]:
    lines = (ROOT / "test" / "rosdep" / "noble_keys.txt").read_text(encoding="utf-8").splitlines()
    return {line for line in lines if not line.startswith("#")}


def ros_packages() -> set[str]:
    """Packages of ROS 2 Jazzy that are installed, by the resource index."""
    prefixes = os.environ["AMENT_PREFIX_PATH"].split(os.pathsep)
    index = "share/ament_index/resource_index/packages"
    return {path.name for prefix in prefixes for path in Path(prefix, index).glob("*")}


def named(package: str, *kinds: str) -> set[str]:
    root = ET.parse(PACKAGES[package]).getroot()
    return {str(one.text) for one in root if one.tag.endswith("depend") and (not kinds or one.tag in kinds)}


def imported(package: str) -> set[str]:
    """Modules from elsewhere that a package's own files import."""
    found = set[str]()
    for path in [*(ROOT / package / package).rglob("*.py"), *(ROOT / package / "launch").rglob("*.py")]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                found |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                found.add(node.module.split(".")[0])
    return found - set(sys.stdlib_module_names) - {package}


@pytest.mark.parametrize("package", PACKAGES)
def test_rosdep_and_ros_know_every_name(package: str) -> None:
    assert named(package) - rosdep_keys() - ros_packages() - PACKAGES.keys() - BINARIES == set()


@pytest.mark.parametrize("package", PACKAGES)
def test_what_a_package_imports_is_named(package: str) -> None:
    wanted = {KEY_OF.get(module, module) for module in imported(package) - WITHOUT_KEY}
    assert wanted - named(package, "depend", "exec_depend") == set()


def test_what_has_no_key_is_said() -> None:
    page = (ROOT / "docs" / "dependencies.md").read_text(encoding="utf-8")
    assert all(f"`pip install {module}`" in " ".join(page.split()) for module in WITHOUT_KEY)
    assert not WITHOUT_KEY & {key.removeprefix("python3-").removesuffix("-pip") for key in rosdep_keys()}
