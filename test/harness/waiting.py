"""Waiting for a condition, never for a time."""

import time
from collections.abc import Callable

LONG = 300.0
"""Deadline that only a broken or hopelessly overloaded run reaches [s]."""


def wait_until(condition: Callable[[], object], what: object, timeout: float = LONG, pause: float = 0.01) -> None:
    """Poll until ``condition`` holds; after ``timeout`` [s] fail with ``what``, a text or a callable that makes it."""
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f"not within {timeout} s: {what() if callable(what) else what}")
        time.sleep(pause)
