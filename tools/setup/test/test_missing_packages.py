"""Packages of ROS 2 that no wheel has: built here, left alone on a stock installation, and the same on the wire."""

import os
import subprocess
from pathlib import Path

import pytest
from rosbags.typesys import Stores, get_typestore

from continuum_manipulator.message_definitions import message_definition
from tools.setup import layout
from tools.setup.environment import venv_environment

MISSING = sorted(path.parent for path in layout.MISSING.glob("*/package.xml"))
MESSAGES = [f"{path.parents[1].name}/msg/{path.stem}" for path in sorted(layout.MISSING.glob("*/msg/*.msg"))]

each_package = pytest.mark.parametrize("package", MISSING, ids=lambda path: path.name)


@each_package
def test_it_is_built_until_the_lock_has_its_wheel(
    package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert package in layout.package_folders()
    lock = tmp_path / "requirements.lock"
    monkeypatch.setattr(layout, "LOCK", lock)
    lock.write_text(f"# lock\nros-jazzy-{package.name.replace('_', '-')}==0.36.0 \\\n")
    assert package not in layout.package_folders()
    lock.write_text(f"# lock\nros-jazzy-{package.name.replace('_', '-')}-other==0.36.0 \\\n")
    assert package in layout.package_folders()


@each_package
@pytest.mark.parametrize("given", ["itself", "the folders above it"])
def test_colcon_takes_it_only_where_it_is_given_itself(package: Path, given: str, tmp_path: Path) -> None:
    paths = [package] if given == "itself" else [layout.MISSING, layout.SETUP]
    result = subprocess.run(
        [layout.VENV / "bin" / "colcon", "--log-base", os.devnull, "build", "--base-paths", *paths,
         "--build-base", tmp_path / "build", "--install-base", tmp_path / "install", "--packages-select", package.name,
         "--packages-skip-regex", ".*"],
        cwd=tmp_path, env=venv_environment(), capture_output=True, text=True, check=True, timeout=120,
    )  # fmt: skip
    assert (f"unknown package '{package.name}'" in result.stderr) is (given != "itself"), result.stderr


@pytest.mark.parametrize("message", MESSAGES)
def test_its_messages_have_the_hash_of_the_stock_ones(message: str) -> None:
    _, installed = message_definition(message)
    assert installed == get_typestore(Stores.ROS2_JAZZY).hash_rihs01(message)
