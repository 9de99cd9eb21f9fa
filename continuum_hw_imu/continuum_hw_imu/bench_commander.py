"""Command of a bench: the claim, the conditions that block tension, and a stop that is latched at both ends."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from continuum.dynamics.live.tension_limit import TensionLimits
from continuum.errors import ContinuumError
from continuum_hw_imu.command_gate import CommandGate
from continuum_hw_imu.link.bench_client import BenchClient
from continuum_hw_imu.protocol.messages import Cause, GuardState, Result

SILENT = 0.5
"""Time without a frame after which a bench counts as silent [s]."""

REOPEN = 3.0
"""Time without a frame after which the port is reopened, in case its name now belongs to another device [s]."""

ANSWER_TIME = 0.5
"""Time within which a bench answers [s]; the wait for slack cables is longer."""

NO_HELLO = "the port is open, but no bench says who it is"
STOPPED = "stopped, until ~/reset_stop"


class BenchError(ContinuumError):
    """A bench did not carry out a request."""


class BenchCommander:
    """Commands a bench; it has no client until the port is opened.

    Args:
        limits: limits of tension; the bench applies its limits too.
        n_cables: number of cables.
        clock: `time.monotonic`, except in tests [s].

    Attributes:
        gate: passes or blocks commands.
        client: client of the bench while the link is maintained, else None.
        mismatch: reason why the connected bench does not match the arm; empty if it does.
        refused: reason why the last attempt to keep the port failed; empty if it succeeded.
    """

    def __init__(self, limits: TensionLimits, n_cables: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self.gate = CommandGate(limits, n_cables)
        self.client: BenchClient | None = None
        self.mismatch = ""
        self.refused = ""

    def line_problem(self) -> str:
        """Problem of the link; empty while frames arrive from a matching bench."""
        client = self.client
        if client is None:
            return "not configured"
        if not client.link.is_open:
            return client.link.problem
        if client.hello is None:
            version = client.decoder.other_version
            return NO_HELLO if version is None else f"the bench speaks version {version} of the protocol"
        silence = client.silent_for(self._clock())
        return self.mismatch or (f"the bench is silent for {silence:.1f} s" if silence > SILENT else "")

    def problem(self) -> str:
        """Problem that blocks tension to a claimed bench; empty if there is none."""
        problem = self.line_problem() or (STOPPED if self.gate.stopped else "")
        return problem or ("" if self.client.commands else self._why_no_commander())

    def _why_no_commander(self) -> str:
        status = self.client.conversation.status
        if status is not None and status.cause is Cause.HEARTBEATS_STOPPED:
            return "the bench missed this node's heartbeats, as of a machine that is too busy; activate the node again"
        return "this node is no longer the bench's commander; activate it again"

    def begin(self) -> str:
        """Claim the bench, waiting for slack cables, and open the gate; return the reason of a failure, or ""."""
        problem = self.line_problem() or (STOPPED if self.gate.stopped else "") or self._claim()
        if not problem:
            self.gate.open()
        return problem

    def end(self) -> None:
        """Release the cables and give back the claim."""
        self.gate.shut()
        if self.client is not None and self.client.commands:
            self.client.release(ANSWER_TIME)

    def let_go(self) -> str:
        """Make the cables slack at once, as for a release test; return the reason of a failure, or ""."""
        problem = self.problem()
        self.gate.let_go()
        if problem:
            return problem
        result = self.client.let_go(ANSWER_TIME)
        return "" if result is Result.DONE else _refusal(result)

    def stop(self) -> None:
        """Latch slack cables at both ends until a reset."""
        self.gate.stop()
        if self.client is not None:
            self.client.stop()

    def reset_stop(self) -> str:
        """End a stop at both ends; return the reason of a failure, or ""."""
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
        """Maintain the link, and a stop at both ends; return True if a stop of the bench was just detected."""
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
        """Send the set points that the gate lets through to a claimed bench."""
        set_point = self.gate.move_on(now)
        self.client.set_tension(set_point.tolist(), self.gate.decided)

    def _claim(self) -> str:
        hello = self.client.hello
        if hello is None:
            return NO_HELLO
        result = self.client.claim(hello.limits.slack_time + ANSWER_TIME)
        return "" if result is Result.DONE else _refusal(result)

    def _state_there(self) -> GuardState | None:
        """Return the bench's state; None while it is unknown."""
        status = None if self.client is None else self.client.conversation.status
        return None if status is None else status.state


def _refusal(result: Result | None) -> str:
    return "the bench does not answer" if result is None else f"the bench answers: {result.name.lower()}"
