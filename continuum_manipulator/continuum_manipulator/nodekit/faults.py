"""Messages that a node refuses."""

from __future__ import annotations


class MessageFault(Exception):
    """A message is invalid and must not be used.

    Args:
        cause: kind of the fault in a few words, under which it is counted.
        detail: the offending value of this message and the allowed values.
    """

    def __init__(self, cause: str, detail: str) -> None:
        self.cause = cause
        self.detail = detail
        super().__init__(f"{cause}: {detail}")
