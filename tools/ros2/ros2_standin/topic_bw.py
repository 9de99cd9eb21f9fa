"""``ros2 topic bw``: bandwidth of a topic."""

from __future__ import annotations

import argparse
import time
from collections import deque

from ros2_standin.qos import add_qos_arguments
from ros2_standin.session import add_discovery_arguments, open_session, positive_int
from ros2_standin.topic_hz import raw_messages

_UNITS = ((1 << 20, "MB"), (1 << 10, "KB"), (1, "B"))


class Bandwidth:
    """Bytes over time of the newest messages.

    Args:
        window: number of messages that count.
    """

    def __init__(self, window: int) -> None:
        self._messages: deque[tuple[float, int]] = deque(maxlen=window)

    def arrive(self, instant: float, size: int) -> None:
        """Record the arrival of a message of ``size`` [bytes] at ``instant`` [s]."""
        self._messages.append((instant, size))

    def text(self, now: float) -> str | None:
        """Return the bandwidth from the oldest counted message to ``now`` [s]; None before the second message."""
        if len(self._messages) < 2:
            return None
        sizes = [size for _, size in self._messages]
        total, duration = sum(sizes), now - self._messages[0][0]
        return (
            f"{amount(total / duration)}/s from {len(sizes)} messages\n"
            f"\tMessage size mean: {amount(total / len(sizes))} min: {amount(min(sizes))} max: {amount(max(sizes))}"
        )


def amount(size: float) -> str:
    """A number of bytes, in the largest unit that leaves at least one."""
    factor, unit = next((entry for entry in _UNITS if size >= entry[0]), _UNITS[-1])
    return f"{size / factor:.2f} {unit}"


def bw_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``bw``."""
    add_discovery_arguments(parser)
    parser.add_argument("topic_name", help="Topic name to monitor for bandwidth utilization")
    parser.add_argument(
        "-w", "--window", type=positive_int, default=100,
        help="maximum window size, in # of messages, for calculating rate (default: 100)",
    )  # fmt: skip
    add_qos_arguments(parser, "subscribe", "sensor_data")


def bw_verb(args: argparse.Namespace) -> None:
    """Print the bandwidth once a second until interrupted; waits for a topic that is not there yet."""
    with open_session(args) as session:
        bandwidth = Bandwidth(args.window)
        with raw_messages(session, args, lambda raw: bandwidth.arrive(time.monotonic(), len(raw))):
            while True:
                session.spin_for(1.0)
                if text := bandwidth.text(time.monotonic()):
                    print(text, flush=True)
