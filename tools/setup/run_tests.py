"""`make test` in three parts, and `make quick`.

Tests that start nodes wait more than they compute: three files run at a time, each module in a separate ROS domain.
Tests that only compute use the remaining processor time at a lower priority: unit tests, one file per core, then the
hidden effects, which distribute their cases themselves.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass
from threading import Event
from typing import Final

_SIDE_BY_SIDE: Final = ("--dist=loadfile", "--numprocesses=auto", "--maxprocesses=4")
PARTS: Final = {
    "nodes": ("--dist=loadfile", "--numprocesses=3"),
    "units": _SIDE_BY_SIDE,
    "hidden-effects": (),
    "quick": _SIDE_BY_SIDE,
}
"""pytest's options for each part, which ``--part``, an option of ``conftest.py``, names; "quick" is some of "units"."""
FIRST: Final = ("nodes",)
REST: Final = ("units", "hidden-effects")

PASSED, NOTHING_TO_RUN = 0, 5
"""Exit codes of pytest."""
_LOWER_PRIORITY: Final = ("nice", "-n", "10")
_SHOWN_EVERY = 0.2  # [s]
_AT_ONCE = 1 << 20  # bytes


@dataclass(frozen=True)
class Ended:
    """One part with pytest's exit code and its duration [s]."""

    part: str
    code: int
    seconds: float

    def __str__(self) -> str:
        word = {PASSED: "passed", NOTHING_TO_RUN: "nothing to run"}.get(self.code, "failed")
        return f"{self.part}: {word}, {self.seconds:.0f} s"


def main(arguments: list[str] | None = None) -> int:
    """Run every part, even after a failure; return pytest's exit code of the first failed part."""
    parser = argparse.ArgumentParser(prog="run_tests", description="Further arguments are given to pytest.")
    parser.add_argument("--quick", action="store_true", help="the fast unit tests alone")
    options, given = parser.parse_known_args(arguments)
    stopped = Event()
    before = signal.signal(signal.SIGINT, lambda *_: stopped.set())  # pytest has it too, and ends with its report
    try:
        ended = run(("quick",), given, stopped) if options.quick else run_all(given, stopped)
    finally:
        signal.signal(signal.SIGINT, before)
    print(*ended, sep="\n", flush=True)
    return exit_code([one.code for one in ended], selected=bool(given))


def run_all(given: Sequence[str], stopped: Event) -> list[Ended]:
    """Run and show the tests with nodes; run the rest at the same time with a lower priority, and show it later."""
    with tempfile.TemporaryFile("w+") as out, ThreadPoolExecutor(1) as pool:
        rest = pool.submit(run, REST, given, stopped, _LOWER_PRIORITY, out.fileno())
        first = run(FIRST, given, stopped)
        shown, done = 0, False
        while not done:
            done = bool(wait([rest], _SHOWN_EVERY).done)
            while text := os.pread(out.fileno(), _AT_ONCE, shown):
                shown += sys.stdout.buffer.write(text)
            sys.stdout.flush()
        return [*first, *rest.result()]


def run(
    parts: Sequence[str], given: Sequence[str], stopped: Event, prefix: Sequence[str] = (), out: int | None = None
) -> list[Ended]:
    """Run parts in sequence until ``stopped`` is set; ``out`` is a file descriptor.

    pytest caches rewritten test modules regardless of the caller's settings for byte code. Each part has a separate
    cache, because simultaneous parts would overwrite each other's list of failures.
    """
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    ended: list[Ended] = []
    for part in parts:
        began = time.monotonic()
        options = (f"--part={part}", f"--override-ini=cache_dir=.pytest_cache/{part}", *PARTS[part])
        command = [*prefix, sys.executable, "-m", "pytest", *options, *given]
        code = subprocess.run(command, check=False, stdout=out, stderr=out, env=environment).returncode
        ended.append(Ended(part, code, time.monotonic() - began))
        if stopped.is_set() or code == -signal.SIGINT:
            break
    return ended


def exit_code(codes: list[int], selected: bool = False) -> int:
    """Return the total exit code; with ``selected`` tests a part may be empty, unless all parts are."""
    if not selected:
        return next(filter(None, codes), PASSED)
    ran = [code for code in codes if code != NOTHING_TO_RUN]
    return next(filter(None, ran), PASSED) if ran else NOTHING_TO_RUN


if __name__ == "__main__":
    sys.exit(main())
