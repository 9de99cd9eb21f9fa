"""What a person sees of a step."""

import os
import sys
from pathlib import Path

import pytest

from tools.setup import progress
from tools.setup.layout import SetupError


@pytest.fixture(autouse=True)
def log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(progress, "LOG_FILE", tmp_path / "log" / "setup.log")
    return tmp_path / "log" / "setup.log"


def python(code: str) -> list[str]:
    return [sys.executable, "-c", code]


def test_output_goes_to_the_log_and_one_line_to_the_person(log: Path, capfd: pytest.CaptureFixture[str]) -> None:
    with progress.Step("baking", "hint") as step:
        step.run(python("print('much output')"), dict(os.environ))
    shown = capfd.readouterr()
    assert shown.out.count("\n") == 1
    assert "baking" in shown.out
    assert "much output" not in shown.out + shown.err
    assert "much output" in log.read_text()


def test_failure_shows_the_end_of_its_own_output_the_hint_and_the_log(log: Path) -> None:
    with progress.Step("baking", "failed; light the oven") as step:
        step.run(python("print('earlier command')"), dict(os.environ))
        with pytest.raises(SetupError) as caught:
            step.run(python("print('no fire'); raise SystemExit(3)"), dict(os.environ))
    text = str(caught.value)
    assert "no fire" in text
    assert "baking: failed; light the oven" in text
    assert str(log) in text
    assert "earlier command" not in text


def test_of_a_long_output_the_end_is_shown() -> None:
    with progress.Step("baking", "hint") as step, pytest.raises(SetupError, match=r"(?s)99\n.*hint") as caught:
        step.run(python("print(*range(100), sep='\\n'); raise SystemExit(3)"), dict(os.environ))
    assert len(str(caught.value).splitlines()) < 40


def test_a_program_that_is_not_there_is_an_error_with_its_name() -> None:
    with pytest.raises(SetupError, match="no-such-program"), progress.Step("baking", "hint") as step:
        step.run(["no-such-program"], dict(os.environ))


def test_commands_run_at_the_same_time(tmp_path: Path, log: Path) -> None:
    """Each waits for a file that the other writes."""
    meet = (
        "import os, sys, time\nopen(sys.argv[1], 'w').close()\nwhile not os.path.exists(sys.argv[2]): time.sleep(0.01)"
    )
    one, other = str(tmp_path / "one"), str(tmp_path / "other")
    with progress.Step("baking", "hint") as step:
        step.run_together([[*python(meet), one, other], [*python(meet), other, one]], dict(os.environ))
    assert log.read_text().count("$ ") == 2


def test_a_failure_ends_the_other_commands(tmp_path: Path) -> None:
    waits = "import time\nwhile True: time.sleep(1)"
    with progress.Step("baking", "hint") as step, pytest.raises(SetupError, match="no fire"):
        step.run_together([python(waits), python("print('no fire'); raise SystemExit(3)")], dict(os.environ))


def test_a_long_step_shows_that_it_lives(monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(progress, "_SIGN_OF_LIFE", 0.0)
    with progress.Step("baking", "hint") as step:
        step.run(python("import time; time.sleep(2.5)"), dict(os.environ))
    dots = capfd.readouterr().out.split("baking ...")[1]
    assert dots.startswith(".")
