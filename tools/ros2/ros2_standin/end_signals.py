"""Signals that end the command, heard also where a library loses what their handlers raise.

rclpy hands messages over in C++: an interrupt that comes meanwhile is raised there, and comes out as another error.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def ends_are_received() -> Iterator[Callable[[], None]]:
    """Note the SIGINT and SIGTERM that come; gives what raises once more what the handler of the last one raised.

    A signal that no handler of Python's takes is left alone.
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
