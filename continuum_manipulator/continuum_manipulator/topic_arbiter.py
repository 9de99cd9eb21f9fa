"""A topic on which the viewer speaks for its user as long as no other node does."""

from __future__ import annotations

from collections import deque

PATIENCE = 0.5
"""For so long after another's message the topic is the other's [s]."""

_REMEMBERED = 100
"""Own stamps: what was said comes back soon, or not at all."""


class TopicArbiter:
    """What is heard on a topic, told apart from what one said oneself by the stamps. Times are of any clock [s]."""

    def __init__(self) -> None:
        self._own: deque[int] = deque(maxlen=_REMEMBERED)
        self._others = -float("inf")
        self._was_free, self._asked = False, -float("inf")

    def said(self, stamp: int) -> None:
        """A message of this stamp [ns] is one's own."""
        self._own.append(stamp)

    def received(self, stamp: int, now: float) -> None:
        """A message of this stamp [ns] came."""
        if stamp not in self._own:
            self._others = now

    def is_taken(self, now: float) -> bool:
        """Whether another spoke lately."""
        return now - self._others <= PATIENCE

    def may_speak(self, now: float) -> bool:
        """Whether nobody else spoke lately; to be asked again and again.

        Nobody must have spoken at the asking a moment before, too: what came while this process stood still is heard
        later than it is asked.
        """
        is_free, lately = not self.is_taken(now), now - self._asked <= PATIENCE
        may, self._was_free, self._asked = is_free and self._was_free and lately, is_free, now
        return may
