"""Suggestions for misspelt names."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

_ONE_LETTER = 0.8
"""Similarity of two names of five characters, such as the option --out, that differ in one character."""


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return ``; did you mean one or other?`` to append to a message about ``word``; empty if no name is similar.

    The suggestion contains all names that may differ from the word in one letter, otherwise the most similar name.
    """
    names = sorted({*known})
    near = get_close_matches(word, names, 3, _ONE_LETTER) or get_close_matches(word, names, 1)
    return f"; did you mean {' or '.join(near)}?" if near else ""
