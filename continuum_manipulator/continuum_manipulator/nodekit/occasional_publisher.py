"""A publisher that exists only while it is in use, because advertising a topic counts as commanding."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class OccasionalPublisher:
    """Callable that publishes messages, and advertises the topic from the first message until it is withdrawn.

    Args:
        advertise: function that creates the publisher.
        withdraw: function that destroys it.
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
        """Stop advertising the topic until the next message."""
        if self._publish is not None:
            self._withdraw(self._publish)
            self._publish = None
