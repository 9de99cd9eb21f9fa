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


def stated(text: str) -> float | None:
    """Seconds that a text states; None if it states nothing."""
    if not text:
        return None
    number, unit = re.fullmatch(r"about (\d+) (s|min) left", text).groups()
    return float(number) * {"s": 1, "min": 60}[unit]


def steady(part: float, whole: float, steps: int) -> list[tuple[float, float]]:
    """Equal steps of work that takes a time in all [s], up to a part of it."""
    return [(part * k / steps, part * k / steps * whole) for k in range(steps + 1)]


@given(part=st.floats(0.0, 1.0), whole=st.floats(1.0, 1e4), steps=st.integers(4, 50))
def test_steady_work_has_as_much_left_as_is_stated(part: float, whole: float, steps: int) -> None:
    left, found = (1 - part) * whole, stated(left_in_words(steady(part, whole, steps), part * whole))
    if part < 0.2:
        assert found is None  # far off
    elif left > 1.01:
        assert found is not None
        assert abs(found - left) <= (10 if left <= 50 else 31)


@given(st.floats(0.2, 1), st.floats(1.0, 1e4), st.floats(0, 1e3), st.floats(0, 1e3))
def test_while_a_stage_lasts_less_and_less_time_is_left(part: float, whole: float, one: float, more: float) -> None:
    steps = steady(part, whole, 4)
    earlier, later = (stated(left_in_words(steps, part * whole + waited)) or 0.0 for waited in (one, one + more))
    assert later <= earlier


@given(st.floats(0.2, 1.0), st.floats(0.5, 0.75), st.floats(1.0, 1e4), st.floats(1.6, 100.0), st.booleans())
def test_nothing_is_stated_while_estimates_disagree(
    part: float, before: float, whole: float, ratio: float, slower: bool
) -> None:
    """A stage that turns out to be much faster or slower than those before it says nothing of those to come."""
    then = whole * (ratio if slower else 1 / ratio)
    steps = [(0.0, 0.0), (before * part, before * part * whole), (part, part * then)]
    assert left_in_words(steps, part * then) == ""


@given(st.floats(0.2, 1.0), st.floats(1.0, 1e4))
def test_nothing_is_stated_from_one_step(part: float, whole: float) -> None:
    assert left_in_words([(part, part * whole)], part * whole) == ""


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
        clock = [520.0]
        patched.setattr("rich.progress.Task.elapsed", property(lambda _: clock[-1]))
        with progress_bar() as tell:
            tell("smoothing", 0.13)
            clock.append(1000.0)
            tell("fitting all segments", 0.25)
    output = b""
    with os.fdopen(master, "rb", buffering=0) as screen, suppress(OSError):  # so a terminal ends on Linux
        while part := screen.read(4096):
            output += part
    shown = [re.sub(r"\x1b\[[^a-zA-Z]*[a-zA-Z]", "", line) for line in re.split(r"[\r\n]+", output.decode())]
    (line,) = {line.rstrip() for line in shown if "fitting" in line}
    assert "fitting all segments" in line
    assert line.endswith("about 50 min left")
    assert len(line) <= 80
