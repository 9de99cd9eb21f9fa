"""The demo as a process of its own, and what is left of it."""

import os
import signal
import subprocess
import sys
from pathlib import Path

from harness.marked import Mark
from harness.waiting import LONG, wait_until

ROOT = Path(__file__).resolve().parents[1]


class DemoProcess:
    """A demo of the nodes that runs, with its results in ``folder``. As a context it is ended with all its nodes.

    Args:
        folder: for results.
        domain: ROS domain.
        options: of its command line.
    """

    def __init__(self, folder: Path, domain: int | str, **options: Path) -> None:
        words = [word for name, value in {"out": folder, **options}.items() for word in (f"--{name}", str(value))]
        self.folder = folder
        self._mark = Mark()
        self._process = subprocess.Popen(
            [sys.executable, "-m", "tools.demo", "--helix-only", *words],
            cwd=ROOT,
            env=os.environ | self._mark.environment | {"ROS_DOMAIN_ID": str(domain), "COLUMNS": "80"},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def __enter__(self) -> "DemoProcess":
        return self

    def __exit__(self, *_: object) -> None:
        for pid in self.processes():
            os.kill(pid, signal.SIGKILL)
        self._process.communicate()

    def processes(self, name: str = "") -> list[int]:
        """Numbers of its processes whose program is called so, its own among them."""
        return self._mark.processes(name)

    def wait_for_node_line(self, text: str) -> None:
        """Wait until a node has said ``text``."""
        log = self.folder / "nodes.log"
        wait_until(lambda: text in (log.read_text() if log.exists() else ""), text, 2 * LONG)

    def send(self, number: signal.Signals) -> None:
        self._process.send_signal(number)

    def end(self) -> tuple[int, str, str]:
        """Wait for the end: exit code, stdout and stderr."""
        out, err = self._process.communicate(timeout=4 * LONG)
        return self._process.returncode, out, err
