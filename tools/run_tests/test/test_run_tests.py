"""Every test is in one of the parts, and a failure of any is one of the whole."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from tools.run_tests import __main__ as run_tests

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]
FILES = (
    "continuum/test/test_arm.py",
    "continuum/test/test_fabrikc.py",
    "test/blind/test_hidden_effects.py",
    "tools/ros2/test/test_graph.py",
)


@pytest.mark.parametrize(
    ("codes", "whole"),
    [
        ([0, 0, 0], 0), ([1, 0, 0], 1), ([0, 1, 0], 1), ([5, 0, 0], 0), ([0, 5, 5], 0), ([5, 0, 1], 1), ([4, 1, 0], 4),
        ([5, 5, 5], 5), ([0, 2], 2),
    ],
)  # fmt: skip
def test_a_failure_of_any_part_is_one_of_the_whole(codes, whole, monkeypatch):
    order = [*run_tests.FIRST, *run_tests.REST]
    remaining, commands = dict(zip(order, codes, strict=False)), []

    def ended(command, **_):
        commands.append(command)
        (part,) = (word.removeprefix("--part=") for word in command if word.startswith("--part="))
        return SimpleNamespace(returncode=remaining.pop(part))

    monkeypatch.setattr(run_tests.subprocess, "run", ended)
    assert run_tests.main(["-k", "cable"]) == whole
    assert not remaining
    assert all(command[-2:] == ["-k", "cable"] for command in commands)


def collected(*options: str) -> list[str]:
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", *options, *FILES]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True, timeout=120)
    return [line for line in done.stdout.splitlines() if "::" in line]


def test_each_test_is_in_one_part():
    parts = {part: collected(f"--part={part}") for part in (*run_tests.FIRST, *run_tests.REST)}
    assert all(parts.values())
    assert sorted(test for part in parts.values() for test in part) == sorted(collected())
    assert set() < set(collected("--part=quick")) < set(parts["units"])
