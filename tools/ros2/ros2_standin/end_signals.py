"""Signals that end the command, even if a library loses the exceptions of their handlers.

rclpy passes messages in C++: an interrupt during this time is raised there and becomes another error.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def ends_are_received() -> Iterator[Callable[[], None]]:
    """Record SIGINT and SIGTERM; yield a function that raises the exception of the last handler again.

    Signals without a Python handler are not changed.
    """
    came: list[int] = []
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    before = {int(number): handler for number, handler in handlers.items() if callable(handler)}

    def take(number: int, frame: FrameType | None) -> None:
        came.append(number)
        before[number](number, frame)

    def raise_again() -> None:
        if came:
            before[came[-1]](came[-1], None)

    for number in before:
        signal.signal(number, take)
    try:
        yield raise_again
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
