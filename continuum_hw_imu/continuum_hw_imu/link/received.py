"""Messages that the host has received from a bench, and statistics of the link."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field

from continuum_hw_imu.protocol.messages import Hello, Message, Result, Status


@dataclass(frozen=True)
class Received:
    """One received message of the bench.

    Attributes:
        message: the message.
        time: instant of its content by `time.monotonic` [s], without the jitter of the transmission.
        error: largest possible error of `time` [s]; infinite as long as the bench has not answered a request.
        read: time by which its bytes had arrived, by the same clock [s].
        device_time: instant of its content by the device's clock, unwrapped [us].
        conversation: number of its conversation.
    """

    message: Message
    time: float
    error: float
    read: float
    device_time: int
    conversation: int


@dataclass
class Conversation:
    """Conversation with one device, until the link is cut or the device restarts.

    Attributes:
        hello: identification of the device; None before it arrives.
        status: latest status of the device.
        newest: device time of the newest frame, unwrapped [us].
        measured: device time of the newest sensor frame [us].
        last: arrival time of the last valid frame by `time.monotonic` [s].
    """

    hello: Hello | None = None
    status: Status | None = None
    newest: int = 0
    measured: int = 0
    last: float = -math.inf


@dataclass
class Results:
    """Results of requests since the process started.

    Attributes:
        asked: number of requests that expect an answer.
        counts: number of answers by result.
    """

    asked: int = 0
    counts: Counter[Result] = field(default_factory=Counter)

    @property
    def unanswered(self) -> int:
        """Number of requests without an answer so far, including pending ones."""
        return self.asked - self.counts.total()
