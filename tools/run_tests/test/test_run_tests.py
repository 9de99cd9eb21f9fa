"""Every test is in one of the parts, and a failure of any is one of the whole."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from tools.run_tests import __main__ as run_tests

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]


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


@pytest.mark.parametrize("markers", [(), ("slow",), ("ros",), ("ros", "slow"), ("hidden_effects",)])
def test_each_test_is_in_one_part(markers: tuple[str, ...], request: pytest.FixtureRequest) -> None:
    item = SimpleNamespace(get_closest_marker=lambda name: name if name in markers else None)
    conftest = request.config.pluginmanager.get_plugin(str(ROOT / "conftest.py"))
    parts = conftest.parts_of(item)
    assert len({*run_tests.FIRST, *run_tests.REST}.intersection(parts)) == 1
    assert ("quick" in parts) == (not markers)
    assert set(parts) <= set(run_tests.PARTS)


@pytest.mark.parametrize("part", run_tests.PARTS)
def test_pytest_takes_the_parts(part: str) -> None:
    file = "tools/run_tests/test/test_run_tests.py"
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", f"--part={part}", file]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=120)
    assert ("::" in done.stdout) == (part == "units")
