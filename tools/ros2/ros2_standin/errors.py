"""The one exception of the stand-in."""

from __future__ import annotations


class UserError(Exception):
    """Something that was typed, or a file that was named, is not right: one line for stderr, no traceback."""
