"""What a launch file asks to be started, in plain values."""

from __future__ import annotations

import shlex
from dataclasses import dataclass


@dataclass(frozen=True)
class ProcessSpec:
    """One process of a launch.

    Attributes:
        name: label before each of its lines, without the number.
        command: words of the command line.
        stdout_to_screen, stderr_to_screen: which of its lines are shown; all go to the log file.
        interrupt_time: time after SIGINT before SIGTERM is sent [s].
        terminate_time: time after SIGTERM before SIGKILL is sent [s].
        action: what asked for it in the launch file.
    """

    name: str
    command: list[str]
    stdout_to_screen: bool = False
    stderr_to_screen: bool = True
    interrupt_time: float = 5.0
    terminate_time: float = 5.0
    action: object = None

    @property
    def line(self) -> str:
        """The command line as a shell would take it."""
        return shlex.join(self.command)
