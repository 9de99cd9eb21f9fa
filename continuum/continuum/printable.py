"""Names of files as text that can be printed and written: not every name on a disk is in UTF-8."""

from __future__ import annotations

import os


def printable(name: str) -> str:
    """The name, bytes that are no text told as hexadecimal numbers."""
    return os.fsencode(name).decode("utf-8", "backslashreplace")


def one_line(text: str) -> str:
    """Text from a file without what moves a terminal's cursor or begins a line."""
    return "".join(letter if letter.isprintable() else "?" for letter in printable(text))
