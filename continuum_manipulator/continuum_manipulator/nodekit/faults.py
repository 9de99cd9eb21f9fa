"""Messages that a node refuses."""

from __future__ import annotations


class MessageFault(Exception):
    """A message that a node must not use.

    Args:
        cause: the kind of fault in a few words, the same for all of its kind; it is what is counted.
        detail: what is wrong with this message: the offending value and what is allowed.
    """

    def __init__(self, cause: str, detail: str) -> None:
        self.cause = cause
        self.detail = detail
        super().__init__(f"{cause}: {detail}")
