"""Ctrl-C while a demo ends what it started: that is ended whole, and the demo is interrupted all the same."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from harness.waiting import wait_until

from tools.demo.nodes import launched

ENDS_LATE = "trap 'kill -{number} {pid}; echo told; exit 0' INT; echo ready; while :; do sleep 0.05; done"
"""Of the shell: a program that sends us a signal when it is interrupted, and then ends."""


@pytest.fixture(params=[signal.SIGINT, signal.SIGTERM])
def number(request: pytest.FixtureRequest) -> Iterator[signal.Signals]:
    """A signal that interrupts this process, as it does a demo."""
    before = signal.signal(request.param, signal.default_int_handler)
    yield request.param
    signal.signal(request.param, before)


def test_an_interrupt_while_something_is_ended_is_not_lost(number: signal.Signals, tmp_path: Path) -> None:
    log = tmp_path / "log"
    command = ["sh", "-c", ENDS_LATE.format(number=int(number), pid=os.getpid())]
    with (
        log.open("w", encoding="utf-8") as output,
        pytest.raises(KeyboardInterrupt),
        launched(command, 0, output.fileno()) as process,
    ):
        wait_until(lambda: "ready" in log.read_text(encoding="utf-8"), "the program")
    assert process.poll() == 0
    assert "told" in log.read_text(encoding="utf-8")


def test_a_signal_that_is_ignored_stays_so(number: signal.Signals, tmp_path: Path) -> None:
    log = tmp_path / "log"
    command = ["sh", "-c", ENDS_LATE.format(number=int(number), pid=os.getpid())]
    with log.open("w", encoding="utf-8") as output, launched(command, 0, output.fileno()):
        wait_until(lambda: "ready" in log.read_text(encoding="utf-8"), "the program")
        signal.signal(number, signal.SIG_IGN)  # now: the shell would have inherited it
    assert signal.getsignal(number) is signal.SIG_IGN
    assert "told" in log.read_text(encoding="utf-8")
