"""Progress: the time that is left follows from what is over, runs down, and is printed line by line in a pipe."""

from __future__ import annotations

import os
import pty
import re
import sys
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.cli.progress import left_in_words, progress_bar


def seconds(text: str) -> float:
    """What a text states; 0 where it states nothing."""
    found = [float(one) for one in re.findall(r"\d+", text)]
    return sum(value * unit for value, unit in zip(reversed(found), (1, 60), strict=False))


@given(st.floats(0, 1), st.floats(0, 1e4))
def test_what_is_left_takes_as_long_as_what_is_over(part: float, elapsed: float) -> None:
    output = seconds(left_in_words(part, elapsed, elapsed))
    if part <= 0.1:
        assert output == 0
    else:
        assert 0 <= elapsed * (1 - part) / part - output < 1


@given(st.floats(0.11, 1), st.floats(0, 1e4), st.floats(0, 1e3), st.floats(0, 1e3))
def test_while_a_stage_lasts_less_and_less_time_is_left(part: float, stated: float, one: float, more: float) -> None:
    earlier, later = (seconds(left_in_words(part, stated, stated + waited)) for waited in (one, one + more))
    assert later <= earlier


def test_without_a_terminal_every_stage_and_every_tenth_has_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_bar() as tell:
        tell("compiling", 0.0)
        for step in range(100):
            tell("particle swarm", step / 100)
    captured = capsys.readouterr()
    assert captured.out == ""
    lines = captured.err.splitlines()
    assert lines[0] == "continuum: compiling"
    assert all(line.startswith("continuum: particle swarm") for line in lines[1:])
    assert 10 <= len(lines) <= 12


def test_a_terminal_of_80_columns_has_step_and_time_left_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    master, slave = pty.openpty()
    with os.fdopen(slave, "w") as terminal, monkeypatch.context() as patched:
        patched.setattr(sys, "stderr", terminal)
        patched.setenv("COLUMNS", "80")
        patched.setenv("TERM", "xterm")
        patched.setattr("rich.progress.Task.elapsed", 1000.0)
        with progress_bar() as tell:
            tell("fitting all segments", 0.25)
    output = b""
    with os.fdopen(master, "rb", buffering=0) as screen, suppress(OSError):  # so a terminal ends on Linux
        while part := screen.read(4096):
            output += part
    shown = [re.sub(r"\x1b\[[^a-zA-Z]*[a-zA-Z]", "", line) for line in re.split(r"[\r\n]+", output.decode())]
    (line,) = {line.rstrip() for line in shown if "fitting" in line}
    assert "fitting all segments" in line
    assert line.endswith("at least 50 min 00 s left")
    assert len(line) <= 80
