"""A publisher that exists only while something is to be said: advertising a topic counts as speaking there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class OccasionalPublisher:
    """Publishes by being called with a message, and advertises the topic from the first one until it is withdrawn.

    Args:
        advertise: makes the publisher.
        withdraw: takes it away.
    """

    def __init__(self, advertise: Callable[[], Any], withdraw: Callable[[Any], object]) -> None:
        self._advertise = advertise
        self._withdraw = withdraw
        self._publish: Any = None

    def __call__(self, message: object) -> None:
        if self._publish is None:
            self._publish = self._advertise()
        self._publish(message)

    def withdraw(self) -> None:
        """Advertise the topic no more, until the next message."""
        if self._publish is not None:
            self._withdraw(self._publish)
            self._publish = None
