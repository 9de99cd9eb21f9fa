"""Arbitration of a topic on which the viewer publishes for its user as long as no other node does."""

from __future__ import annotations

from collections import deque

PATIENCE = 0.5
"""Time after a message of another node for which the topic belongs to it [s]."""

_REMEMBERED = 100
"""Number of remembered stamps of published messages, which return soon or not at all."""


class TopicArbiter:
    """Distinguishes messages of other nodes from published ones by their stamps; times are of any one clock [s]."""

    def __init__(self) -> None:
        self._own: deque[int] = deque(maxlen=_REMEMBERED)
        self._others = -float("inf")
        self._was_free, self._asked = False, -float("inf")

    def said(self, stamp: int) -> None:
        """Record the stamp [ns] of a published message."""
        self._own.append(stamp)

    def received(self, stamp: int, now: float) -> None:
        """Record a received message with this stamp [ns]."""
        if stamp not in self._own:
            self._others = now

    def is_taken(self, now: float) -> bool:
        """Return whether another node has published recently."""
        return now - self._others <= PATIENCE

    def may_speak(self, now: float) -> bool:
        """Return whether no other node has published recently; call this repeatedly.

        The result is True only if the topic was also free at the previous call, because messages that arrived while
        this process was suspended are processed after the first call.
        """
        is_free, lately = not self.is_taken(now), now - self._asked <= PATIENCE
        may, self._was_free, self._asked = is_free and self._was_free and lately, is_free, now
        return may
