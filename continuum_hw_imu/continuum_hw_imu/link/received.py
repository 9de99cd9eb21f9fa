"""What the host has heard of one bench, and what that says of the line."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field

from continuum_hw_imu.protocol.messages import Hello, Message, Result, Status


@dataclass(frozen=True)
class Received:
    """One message of the bench.

    Attributes:
        message: itself.
        time: instant that it tells of, by `time.monotonic` [s], without the jitter of the way.
        read: when its bytes were there, by the same clock [s].
        device_time: the instant by the device's clock, unwrapped [us].
        conversation: number of the conversation that it is a part of.
    """

    message: Message
    time: float
    read: float
    device_time: int
    conversation: int


@dataclass
class Conversation:
    """With one device, from when it said who it is until the line is cut or it begins anew.

    Attributes:
        hello: who it is; None until it said so.
        status: its latest.
        newest: device time of the newest frame, unwrapped [us].
        measured: device time of the newest frame of the sensors [us].
        last: when the last good frame came, by `time.monotonic` [s].
    """

    hello: Hello | None = None
    status: Status | None = None
    newest: int = 0
    measured: int = 0
    last: float = -math.inf


@dataclass
class Results:
    """What became of requests, since the process began.

    Attributes:
        asked: requests that are answered.
        counts: answers by result.
    """

    asked: int = 0
    counts: Counter[Result] = field(default_factory=Counter)

    @property
    def unanswered(self) -> int:
        """Requests without an answer so far; those under way among them."""
        return self.asked - self.counts.total()
