"""Command of a bench: who has it, what keeps tension from going through, and a stop that holds at both ends."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from continuum.dynamics.live.tension_limit import TensionLimits
from continuum.errors import ContinuumError
from continuum_hw_imu.command_gate import CommandGate
from continuum_hw_imu.link.bench_client import BenchClient
from continuum_hw_imu.protocol.messages import GuardState, Result

SILENT = 0.5
"""Time without a frame from which a bench is silent [s]."""

REOPEN = 3.0
"""Time without a frame after which the port is opened anew, in case its name is another device's by now [s]."""

ANSWER_TIME = 0.5
"""Within which a bench answers [s]; for slack cables it is waited longer."""

NO_HELLO = "the port is open, but no bench says who it is"
STOPPED = "stopped, until ~/reset_stop"


class BenchError(ContinuumError):
    """A bench did not do what it was asked."""


class BenchCommander:
    """Without a client, until the port is opened.

    Args:
        limits: of tension; the bench keeps its own besides.
        n_cables: number of cables.
        clock: shows what `time.monotonic` does, but to tests [s].

    Attributes:
        gate: what goes through.
        client: the line to the bench, while it is kept up.
        misfit: why the bench at the other end is not the right one; empty where it is.
        refused: why the port was not kept at the last attempt; empty where it was.
    """

    def __init__(self, limits: TensionLimits, n_cables: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self.gate = CommandGate(limits, n_cables)
        self.client: BenchClient | None = None
        self.deviance = ""
        self.refused = ""

    def line_problem(self) -> str:
        """What is wrong with the line; empty where frames come from a bench that fits."""
        client = self.client
        if client is None:
            return "not configured"
        if not client.link.is_open:
            return client.link.problem
        if client.hello is None:
            version = client.decoder.other_version
            return NO_HELLO if version is None else f"the bench speaks version {version} of the protocol"
        silence = client.silent_for(self._clock())
        return self.deviance or (f"the bench is silent for {silence:.1f} s" if silence > SILENT else "")

    def problem(self) -> str:
        """What keeps tension from going through to a bench that is claimed; empty if nothing does."""
        problem = self.line_problem() or (STOPPED if self.gate.stopped else "")
        return problem or ("" if self.client.commands else "this node is no longer the bench's commander")

    def begin(self) -> str:
        """Claim the bench, waiting for slack cables, and open the gate; why that did not work, empty if it did."""
        problem = self.line_problem() or (STOPPED if self.gate.stopped else "") or self._claim()
        if not problem:
            self.gate.open()
        return problem

    def end(self) -> None:
        """Let the cables go, and command no more."""
        self.gate.shut()
        if self.client is not None and self.client.commands:
            self.client.release(ANSWER_TIME)

    def let_go(self) -> str:
        """Slack cables at once, as for a release test; why that did not work, empty if it did."""
        problem = self.problem()
        self.gate.let_go()
        if problem:
            return problem
        result = self.client.let_go(ANSWER_TIME)
        return "" if result is Result.DONE else _refusal(result)

    def stop(self) -> None:
        """Slack, here and there, until it is reset."""
        self.gate.stop()
        if self.client is not None:
            self.client.stop()

    def reset_stop(self) -> str:
        """End a stop at both ends; why that did not work, empty if it did."""
        problem = self.line_problem() or self._claim()
        if problem:
            return problem
        client = self.client
        result = client.reset_stop(ANSWER_TIME)
        client.wait_for(lambda: self._state_there() is not GuardState.STOPPED, ANSWER_TIME)
        client.release(ANSWER_TIME)
        if result is not Result.DONE:
            return _refusal(result)
        self.gate.reset()
        return ""

    def keep_up(self, now: float) -> bool:
        """Keep the line up and a stop at both ends; True if a stop that began at the bench was found just now."""
        client = self.client
        if client is None:
            return False
        client.ask_who(now)
        silence = client.silent_for(now)
        if client.hello is not None and REOPEN < silence < math.inf:
            client.link.reopen()
        if self.gate.stopped and self._state_there() is not GuardState.STOPPED:
            client.stop()
        elif self._state_there() is GuardState.STOPPED and not self.gate.stopped:
            self.gate.stop()
            return True
        return False

    def send(self, now: float) -> None:
        """Send what the gate lets through; for a bench that is claimed."""
        set_point = self.gate.move_on(now)
        self.client.set_tension(set_point.tolist(), self.gate.decided)

    def _claim(self) -> str:
        hello = self.client.hello
        if hello is None:
            return NO_HELLO
        result = self.client.claim(hello.limits.slack_time + ANSWER_TIME)
        return "" if result is Result.DONE else _refusal(result)

    def _state_there(self) -> GuardState | None:
        """The bench's state, None while it is not known."""
        status = None if self.client is None else self.client.conversation.status
        return None if status is None else status.state


def _refusal(result: Result | None) -> str:
    return "the bench does not answer" if result is None else f"the bench answers: {result.name.lower()}"
