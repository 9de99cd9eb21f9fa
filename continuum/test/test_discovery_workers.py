"""Trials in processes of their own: an interrupt from the terminal ends them all, and is told in one line."""

import os
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

MEASURED = Path(__file__).parents[2] / "data" / "rep7" / "rep7_measured.csv"
LONG = 120.0  # s


def workers_of(pid: int) -> list[str]:
    """Process numbers of the workers that a process has started."""
    children = (task.read_text().split() for task in Path(f"/proc/{pid}/task").glob("*/children"))
    return [
        child for found in children for child in found if b"spawn_main" in Path(f"/proc/{child}/cmdline").read_bytes()
    ]


def wait_for(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_an_interrupt_ends_every_process_and_is_told_in_one_line() -> None:
    command = ["continuum", "diagnose", str(MEASURED), "--processes", "2"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True) as process:
        try:
            wait_for(lambda: len(workers_of(process.pid)) == 2)
            workers = workers_of(process.pid)
            os.killpg(process.pid, signal.SIGINT)  # as a terminal does
            told = process.communicate(timeout=LONG)[1]
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
    assert process.returncode == 130
    assert told.strip().splitlines()[-1] == "continuum: stopped"
    assert "Traceback" not in told
    wait_for(lambda: not any(Path(f"/proc/{worker}").exists() for worker in workers))
