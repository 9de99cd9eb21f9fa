"""Every test is in one of the two parts, and a failure of either is one of the whole."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from tools.run_tests import __main__ as run_tests

ROOT = Path(__file__).parents[3]
OF_THE_LIBRARY, OTHER = "continuum/test/test_arm.py", "test/test_pages.py"


@pytest.mark.parametrize(
    ("codes", "whole"),
    [([0, 0], 0), ([1, 0], 1), ([0, 1], 1), ([5, 0], 0), ([0, 5], 0), ([5, 1], 1), ([4, 1], 4), ([5, 5], 5), ([2], 2)],
)
def test_a_failure_of_either_part_is_one_of_the_whole(codes, whole, monkeypatch):
    remaining, commands = iter(codes), []

    def ended(command, **_):
        commands.append(command)
        return SimpleNamespace(returncode=next(remaining))

    monkeypatch.setattr(run_tests.subprocess, "run", ended)
    assert run_tests.main(["-k", "cable"]) == whole
    assert not list(remaining)
    assert all(command[-2:] == ["-k", "cable"] for command in commands)


@pytest.mark.parametrize(("part", "there"), [("only", OF_THE_LIBRARY), ("left-out", OTHER)])
def test_each_test_is_in_one_part(part, there):
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", f"--library={part}", OF_THE_LIBRARY, OTHER]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True, timeout=120)
    collected = {line.partition("::")[0] for line in done.stdout.splitlines() if "::" in line}
    assert collected == {there}
