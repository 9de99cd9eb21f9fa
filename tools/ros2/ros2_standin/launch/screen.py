"""Where the lines of a launch go: screen and log file."""

from __future__ import annotations

import os
import socket
import sys
import time
from collections.abc import Callable
from pathlib import Path

from ros2_standin.errors import UserError


def log_root() -> Path:
    """The folder of ROS's logs: ROS_LOG_DIR, else ROS_HOME/log, else ~/.ros/log."""
    if root := os.environ.get("ROS_LOG_DIR"):
        return Path(root).expanduser()
    return Path(os.environ.get("ROS_HOME") or "~/.ros").expanduser() / "log"


class Screen:
    """Writes lines to stdout and to ``launch.log``.

    Args:
        on_broken: called once when nobody reads stdout any more.

    Raises:
        UserError: the log folder cannot be made.
    """

    def __init__(self, on_broken: Callable[[], None]) -> None:
        self.folder = log_root() / f"{time.strftime('%Y-%m-%d-%H-%M-%S')}-{socket.gethostname()}-{os.getpid()}"
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self._log = (self.folder / "launch.log").open("a", buffering=1, encoding="utf-8", errors="replace")
        except OSError as error:
            raise UserError(
                f"no log can be written to {self.folder} ({error.strerror}); ROS_LOG_DIR names another"
            ) from error
        self._on_broken = on_broken
        self._broken = False

    def close(self) -> None:
        """End the log file."""
        self._log.close()

    def say(self, level: str, source: str, text: str) -> None:
        """A line of the launch itself, e.g. ``[INFO] [launch]: text``; debug goes to the log only."""
        self.line(f"[{level.upper()}] [{source}]: {text}", shown=level != "debug")

    def line(self, text: str, shown: bool) -> None:
        """One line to the log, and to the screen where ``shown``."""
        self._log.write(f"{time.time():.7f} {text}\n")
        if shown and not self._broken:
            try:
                sys.stdout.write(f"{text}\n")
                sys.stdout.flush()
            except BrokenPipeError:
                self._broken = True
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
                self._on_broken()
