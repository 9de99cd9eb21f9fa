"""The exception of the stand-in."""

from __future__ import annotations


class UserError(Exception):
    """Invalid user input or an invalid file: one line for stderr, no traceback."""
