"""Every test is in one of the parts, and a failure of any is one of the whole."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from tools.setup import run_tests

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize(
    ("codes", "whole"),
    [
        ([0, 0, 0], 0), ([1, 0, 0], 1), ([0, 1, 0], 1), ([5, 0, 0], 0), ([0, 5, 5], 0), ([5, 0, 1], 1), ([4, 1, 0], 4),
        ([5, 5, 5], 5), ([0, 2, 0], 2),
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


def test_nothing_to_run_is_a_failure_unless_tests_were_selected(monkeypatch):
    monkeypatch.setattr(run_tests.subprocess, "run", lambda *_, **__: SimpleNamespace(returncode=5))
    assert run_tests.main([]) == 5
    assert run_tests.exit_code([0, 5, 0]) == 5
    assert run_tests.exit_code([0, 5, 0], selected=True) == 0


def test_an_interrupt_ends_the_run_whatever_the_part_says(monkeypatch):
    begun = []

    def interrupted(command, **_):
        begun.append(command)
        os.kill(os.getpid(), signal.SIGINT)
        return SimpleNamespace(returncode=-signal.SIGINT)

    monkeypatch.setattr(run_tests.subprocess, "run", interrupted)
    assert run_tests.main([]) != 0
    assert len(begun) <= 2  # one of each that run at the same time


def test_a_marker_that_the_text_does_not_show_is_refused(tmp_path):
    (tmp_path / "conftest.py").write_text(
        (ROOT / "conftest.py").read_text(encoding="utf-8").replace("if importlib", "if 0 and importlib")
    )
    (tmp_path / "marks.py").write_text("import pytest\nAWAY = pytest.mark.ros\n")
    (tmp_path / "test_one.py").write_text("from marks import AWAY\n\n\n@AWAY\ndef test_one():\n    pass\n")
    (tmp_path / "pytest.ini").write_text("[pytest]\npythonpath = .\nmarkers =\n    ros\n    slow\n    hidden_effects\n")
    command = [sys.executable, "-m", "pytest", "--part=units", "-p", "no:cacheprovider"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 4
    assert "its marker is not seen in the text" in done.stderr + done.stdout


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
    file = "tools/setup/test/test_run_tests.py"
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", f"--part={part}", file]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=120)
    assert ("::" in done.stdout) == (part == "units")
