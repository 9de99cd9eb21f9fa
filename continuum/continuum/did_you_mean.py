"""The names that a misspelt one is near to."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

_ONE_LETTER = 0.8
"""Similarity of two names of five characters, as the option --out is, of which one character differs."""


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """``; did you mean one or other?``, to be put behind what is wrong with ``word``; empty where no name is near.

    Names that one letter may separate from the word are all given, else the nearest one.
    """
    names = sorted({*known})
    near = get_close_matches(word, names, 3, _ONE_LETTER) or get_close_matches(word, names, 1)
    return f"; did you mean {' or '.join(near)}?" if near else ""
