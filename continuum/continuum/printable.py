"""Names of files as text that can be printed and written: not every name on a disk is in UTF-8."""

from __future__ import annotations

import os


def printable(name: str) -> str:
    """The name, bytes that are no text told as hexadecimal numbers."""
    return os.fsencode(name).decode("utf-8", "backslashreplace")


def one_line(text: str) -> str:
    """What files and users name may hold any character; one that is not printable is escaped as Python does."""
    return "".join(mark if mark.isprintable() else mark.encode("unicode_escape").decode() for mark in text)
