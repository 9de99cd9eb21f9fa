"""The bench controller's side of the protocol: bytes of the host in, tensions and answers out.

What a firmware has to do, without its hardware and its clock: whoever runs it gives bytes and times.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.live.stepper import Interval
from continuum_hw_imu.protocol.decoder import Decoder
from continuum_hw_imu.protocol.frame import Frame
from continuum_hw_imu.protocol.messages import (
    Ack,
    Cause,
    Claim,
    FaultCode,
    Heartbeat,
    Hello,
    HelloRequest,
    LetGo,
    Message,
    Release,
    ResetStop,
    Result,
    SetTension,
    Status,
    Stop,
    TensionFrame,
)
from continuum_hw_imu.protocol.sequence import Arrival, SequenceTracker
from continuum_hw_imu.receiver.fault_board import FaultBoard
from continuum_hw_imu.receiver.safety_guard import SafetyGuard

STATUS_PERIOD = 100_000
"""Between two `Status` at most [us]."""

_WRAP_COUNT = 1 << 16


@dataclass(frozen=True)
class _Condition:
    """What a `Status` is sent at once for when it changes."""

    state: int
    cause: int
    claimed: bool
    faults: int


class BenchController:
    """Times [us] are of the device's clock, unwrapped.

    Args:
        hello: who the device is.

    Attributes:
        guard: the rules of safety.
        faults: what is wrong.
        batteries: charge of each sensor [%], None where it is not known.
        arrivals: numbers of the host's frames.
        decoder: its ear.
    """

    def __init__(self, hello: Hello) -> None:
        self._hello = hello
        self.decoder = Decoder.of_device()
        self.arrivals = SequenceTracker()
        self.guard = SafetyGuard(hello.limits, hello.n_cables)
        self.faults = FaultBoard()
        self.batteries: list[int | None] = [None] * len(hello.sensors)
        self._reported: _Condition | None = None
        self._reported_at = 0

    def connect(self) -> list[Message]:
        """A host has opened the port; what it is told first."""
        self._forget_line()
        return [self._hello]

    def disconnect(self) -> None:
        """The host's end of the port is closed, or the cable is out."""
        self._forget_line()
        self.guard.lose_link()

    def hear(self, data: bytes, now: int) -> list[Message]:
        """Obey bytes of the host, if they are any frames; the answers."""
        answers: list[Message] = []
        for frame in self.decoder.feed(data):
            answer = self._obey(frame, now)
            if answer is not None:
                answers.append(answer)
        return answers

    def move_on(self, now: int, duration: float) -> Interval:
        """The set points from ``now`` on for a ``duration`` [s], which then are in force."""
        interval = self.guard.move_on(now, duration)
        cause = self.guard.cause
        self.faults.put(cause is Cause.COMMANDS_STOPPED and self.guard.abandoned, FaultCode.COMMANDS_STOPPED)
        self.faults.put(cause is Cause.HEARTBEATS_STOPPED and not self.guard.claimed, FaultCode.HEARTBEATS_STOPPED)
        return interval

    def news(self, now: int) -> list[Message]:
        """Faults that began, and a `Status` where one is due."""
        messages: list[Message] = [*self.faults.take_unreported()]
        condition = _Condition(self.guard.state, self.guard.cause, self.guard.claimed, self.faults.bits)
        if condition != self._reported or now - self._reported_at >= STATUS_PERIOD:
            self._reported, self._reported_at = condition, now
            messages.append(self.status())
        return messages

    def status(self) -> Status:
        """As it is now."""
        good, refused = (count % _WRAP_COUNT for count in (self.decoder.good, self.decoder.refused))
        guard = self.guard
        return Status(guard.state, guard.cause, guard.claimed, self.faults.bits, good, refused, tuple(self.batteries))

    def tension_frame(self, measured: Sequence[float | None]) -> TensionFrame:
        """Of measured tensions (n_cables,) [N]."""
        return TensionFrame(tuple(self._in_force().tolist()), tuple(measured))

    def _in_force(self) -> Array:
        return np.asarray(self.guard.set_points)

    def _forget_line(self) -> None:
        self.decoder.forget()
        self.arrivals.forget()

    def _obey(self, frame: Frame, now: int) -> Message | None:
        """Carry out what a frame asks for; the answer, if there is one."""
        request = frame.message
        if isinstance(request, HelloRequest):
            self.arrivals.forget()  # a host that begins also counts anew
            self.arrivals.take(frame.sequence)
            return self._hello
        arrival = self.arrivals.take(frame.sequence)
        if isinstance(request, Stop):
            arrival = Arrival.NEW  # whenever it comes, and however often
        if arrival is Arrival.REPEATED:
            return None
        if arrival is Arrival.LATE:
            return Ack(frame.sequence, request.TYPE, Result.OUT_OF_ORDER)
        result = self._carried_out(request, frame.sequence, now)
        if isinstance(request, Heartbeat) and result is Result.DONE:
            return None
        return Ack(frame.sequence, request.TYPE, result)

    def _carried_out(self, request: Message, sequence: int, now: int) -> Result:
        guard = self.guard
        match request:
            case SetTension(token, as_of, tensions):
                return guard.set_tension(token, sequence, as_of, tensions, now)
            case Heartbeat(token):
                return guard.heartbeat(token, now)
            case Claim(token):
                return guard.claim(token, now)
            case Release(token):
                return guard.release(token, now)
            case LetGo(token):
                return guard.let_go(token, now)
            case ResetStop(token, as_of):
                return guard.reset_stop(token, as_of, now)
            case Stop():
                return guard.stop(now)
            case _:
                return Result.REFUSED
