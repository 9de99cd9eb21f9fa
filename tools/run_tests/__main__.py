"""`make test` in three parts, and `make quick`.

Tests that start nodes wait more than they compute: three files at a time, each module in a separate ROS domain. Unit
tests compute: one file for each core. The hidden effects share out their cases themselves.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from typing import Final

_SIDE_BY_SIDE: Final = ("--dist=loadfile", "--numprocesses=auto", "--maxprocesses=4")
PARTS: Final = {
    "nodes": ("--dist=loadfile", "--numprocesses=3"),
    "units": _SIDE_BY_SIDE,
    "hidden-effects": (),
}
"""What pytest is told for each part of all tests; ``--part`` is an option of ``conftest.py``."""

QUICK: Final = {"quick": _SIDE_BY_SIDE}
"""The fast ones of the unit tests alone."""


PASSED, INTERRUPTED, NOTHING_TO_RUN = 0, 2, 5
"""Exit codes of pytest."""


def main(arguments: list[str] | None = None) -> int:
    """Run every part, also after one that failed; give pytest's exit code of the first that failed."""
    parser = argparse.ArgumentParser(prog="run_tests", description="Further arguments are given to pytest.")
    parser.add_argument("--quick", action="store_true", help="the fast unit tests alone")
    options, given = parser.parse_known_args(arguments)
    codes, lines = list[int](), list[str]()
    for part, how in (QUICK if options.quick else PARTS).items():
        began = time.monotonic()
        command = [sys.executable, "-m", "pytest", f"--part={part}", *how, *given]
        codes.append(subprocess.run(command, check=False).returncode)
        word = {PASSED: "passed", NOTHING_TO_RUN: "nothing to run"}.get(codes[-1], "failed")
        lines.append(f"{part}: {word}, {time.monotonic() - began:.0f} s")
        if codes[-1] == INTERRUPTED:
            break
    print("\n".join(lines), flush=True)
    return exit_code(codes)


def exit_code(codes: list[int]) -> int:
    """Exit code of the whole: a part without tests is no failure unless no part has any."""
    ran = [code for code in codes if code != NOTHING_TO_RUN]
    return next(filter(None, ran), PASSED) if ran else NOTHING_TO_RUN


if __name__ == "__main__":
    sys.exit(main())
