"""``python3 -m tools.setup.browser``: fetch missing parts and report what is available; always succeed."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.metadata import distributions

from tools.setup.browser.debian_chromium import NoChromiumError, fetch
from tools.setup.browser.place import EXTRA, Chromium, chromium, environment

PATIENCE = 60.0
"""Longest wait for the version of a program [s]."""


def main() -> int:
    """Fetch Chromium unless there is one, and print the places of Chromium and Playwright."""
    program = chromium()
    if program is None:
        try:
            fetch()
        except NoChromiumError as error:
            print(f"no Chromium ({error}): the browser tests are skipped", file=sys.stderr)
        program = chromium()
    if program is not None:
        print(f"Chromium: {program.path} ({version(program)})")
    for found in distributions(name="playwright", path=[str(EXTRA)]):
        print(f"Playwright: {os.path.relpath(EXTRA)} ({found.version})")
    return 0


def version(program: Chromium) -> str:
    """Return the version that the program prints."""
    try:
        done = subprocess.run(
            [program.path, "--version"], capture_output=True, text=True, timeout=PATIENCE, env=environment(program)
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"which does not run: {error}"
    return done.stdout.strip() or f"which does not run: exit code {done.returncode}"


if __name__ == "__main__":
    sys.exit(main())
