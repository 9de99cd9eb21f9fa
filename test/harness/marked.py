"""Processes that carry a mark in their environment, which they gave to all that they started."""

import os
import signal
import uuid
from pathlib import Path

from harness.waiting import wait_until

MARK = "CONTINUUM_TEST_MARK"


class Mark:
    """A mark of its own; give `environment` to a process, and find it with all its children."""

    def __init__(self) -> None:
        self._value = uuid.uuid4().hex
        self.environment = {MARK: self._value}

    def processes(self, name: str = "") -> list[int]:
        """Numbers of the living that carry it and whose program is called so."""
        found = []
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                marked = f"{MARK}={self._value}".encode() in (folder / "environ").read_bytes()
                words = (folder / "cmdline").read_bytes().decode(errors="replace").split("\0")
            except OSError:  # ended meanwhile, or another's
                continue
            if marked and any(word.endswith(name) for word in words):
                found.append(int(folder.name))
        return found

    def kill(self) -> None:
        """Kill all of them, and wait until they are gone."""
        for pid in self.processes():
            os.kill(pid, signal.SIGKILL)
        wait_until(lambda: not self.processes(), "end of what was killed")
