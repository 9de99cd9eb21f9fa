"""`.venv/bin/ros2` gives way to a stock `ros2`, and to nothing else."""

import os
import subprocess
from pathlib import Path

import pytest

from tools.setup.layout import VENV


@pytest.fixture
def other(tmp_path: Path) -> Path:
    """A program called ros2 further down the PATH."""
    path = tmp_path / "b in" / "ros2"
    path.parent.mkdir()
    path.write_text('#!/bin/sh\necho "other: $@"\n')
    path.chmod(0o755)
    return path


def run(other: Path, *arguments: str) -> str:
    environment = os.environ | {"PATH": f"{VENV / 'bin'}:{other.parent}:{os.environ['PATH']}"}
    result = subprocess.run(
        [VENV / "bin" / "ros2", *arguments], env=environment, capture_output=True, text=True, check=True, timeout=120
    )
    return result.stdout


def test_a_stock_ros2_is_called_with_the_same_arguments(other: Path) -> None:
    assert run(other, "topic", "echo", "a b") == "other: topic echo a b\n"


def test_the_stand_in_of_another_checkout_is_not_called(other: Path) -> None:
    other.write_text(other.read_text() + "# ros2_standin\n")
    assert "other:" not in run(other, "--help")
