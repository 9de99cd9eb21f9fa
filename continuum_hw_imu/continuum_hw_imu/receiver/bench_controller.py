"""The bench controller's side of the protocol: bytes from the host in, tensions and answers out.

It specifies the behaviour of a firmware, without hardware and clock: its caller supplies bytes and times.
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
"""Longest time between two `Status` messages [us]."""

_WRAP_COUNT = 1 << 16


@dataclass(frozen=True)
class _Condition:
    """The values whose change triggers a `Status` at once."""

    state: int
    cause: int
    claimed: bool
    faults: int


class BenchController:
    """Bench controller; times [us] are those of the device's clock, unwrapped.

    Args:
        hello: identification of the device.

    Attributes:
        guard: the safety rules.
        faults: the faults of the device.
        batteries: charge of each sensor [%], None where it is unknown.
        arrivals: tracker of the host's frame numbers.
        decoder: decoder of the host's frames.
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
        """Return the first messages to a host that has opened the port."""
        self._forget_line()
        return [self._hello]

    def disconnect(self) -> None:
        """React to the closing of the port by the host, or to the unplugged cable."""
        self._forget_line()
        self.guard.lose_link()

    def hear(self, data: bytes, now: int) -> list[Message]:
        """Carry out the requests in bytes from the host, and return the answers."""
        answers: list[Message] = []
        for frame in self.decoder.feed(data):
            answer = self._obey(frame, now)
            if answer is not None:
                answers.append(answer)
        return answers

    def move_on(self, now: int, duration: float) -> Interval:
        """Advance the set points by a ``duration`` [s] from ``now`` [us], and return their interval."""
        interval = self.guard.move_on(now, duration)
        cause = self.guard.cause
        self.faults.put(cause is Cause.COMMANDS_STOPPED and self.guard.abandoned, FaultCode.COMMANDS_STOPPED)
        self.faults.put(cause is Cause.HEARTBEATS_STOPPED and not self.guard.claimed, FaultCode.HEARTBEATS_STOPPED)
        return interval

    def news(self, now: int) -> list[Message]:
        """Return new faults, and a `Status` if one is due."""
        messages: list[Message] = [*self.faults.take_unreported()]
        condition = _Condition(self.guard.state, self.guard.cause, self.guard.claimed, self.faults.bits)
        if condition != self._reported or now - self._reported_at >= STATUS_PERIOD:
            self._reported, self._reported_at = condition, now
            messages.append(self.status())
        return messages

    def status(self) -> Status:
        """Return the present status."""
        good, refused = (count % _WRAP_COUNT for count in (self.decoder.good, self.decoder.refused))
        guard = self.guard
        return Status(guard.state, guard.cause, guard.claimed, self.faults.bits, good, refused, tuple(self.batteries))

    def tension_frame(self, measured: Sequence[float | None]) -> TensionFrame:
        """Return the tension frame with measured tensions (n_cables,) [N]."""
        return TensionFrame(tuple(self._in_force().tolist()), tuple(measured))

    def _in_force(self) -> Array:
        return np.asarray(self.guard.set_points)

    def _forget_line(self) -> None:
        self.decoder.forget()
        self.arrivals.forget()

    def _obey(self, frame: Frame, now: int) -> Message | None:
        """Carry out the request in a frame, and return the answer if there is one."""
        request = frame.message
        if isinstance(request, HelloRequest):
            self.arrivals.forget()  # a host that starts also restarts its count
            self.arrivals.take(frame.sequence)
            return self._hello
        arrival = self.arrivals.take(frame.sequence)
        if isinstance(request, Stop):
            arrival = Arrival.NEW  # valid at any time and any number of times
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
