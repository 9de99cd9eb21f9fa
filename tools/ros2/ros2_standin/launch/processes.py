"""What a launch file asks to be started, in plain values."""

from __future__ import annotations

import shlex
from dataclasses import dataclass, field


@dataclass(frozen=True)
class ProcessSpec:
    """One process of a launch.

    Attributes:
        name: label before each of its lines, without the number.
        command: words of the command line.
        environment: its whole environment.
        folder: working folder, None for the launch's own.
        stdout_to_screen, stderr_to_screen: which of its lines are shown; all go to the log file.
        respawn: start it again when it ends by itself.
        respawn_delay: pause before that [s].
        respawn_limit: how often at most, -1 for ever.
        ends_launch: everything is shut down when it ends.
        interrupt_time: time after SIGINT before SIGTERM is sent [s].
        terminate_time: time after SIGTERM before SIGKILL is sent [s].
    """

    name: str
    command: list[str]
    environment: dict[str, str] = field(repr=False)
    folder: str | None = None
    stdout_to_screen: bool = False
    stderr_to_screen: bool = True
    respawn: bool = False
    respawn_delay: float = 0.0
    respawn_limit: int = -1
    ends_launch: bool = False
    interrupt_time: float = 5.0
    terminate_time: float = 5.0

    @property
    def line(self) -> str:
        """The command line as a shell would take it."""
        return shlex.join(self.command)


@dataclass(frozen=True)
class LogLine:
    """A line that the launch itself says when it gets there."""

    level: str
    text: str
