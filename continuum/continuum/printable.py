"""Printable text for file names, which are not always valid UTF-8."""

from __future__ import annotations

import os


def printable(name: str) -> str:
    """Return the name with bytes that are not valid text as hexadecimal numbers."""
    return os.fsencode(name).decode("utf-8", "backslashreplace")


def one_line(text: str) -> str:
    """Return the text with every non-printable character escaped as in Python."""
    return "".join(mark if mark.isprintable() else mark.encode("unicode_escape").decode() for mark in text)
