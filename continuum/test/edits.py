"""Words at an edit distance of 1 from a name: one letter replaced, left out or put in."""

import string

from hypothesis import strategies as st

LETTERS = string.ascii_lowercase + "-_"


@st.composite
def misspelt(draw: st.DrawFn, name: str, first: int = 0) -> str:
    """A word that differs from the name by one letter at or behind ``first``."""
    kind = draw(st.sampled_from(["replaced", "left out", "put in"]))
    at = draw(st.integers(first, len(name) - (kind != "put in")))
    letter = "" if kind == "left out" else draw(st.sampled_from(LETTERS))
    return name[:at] + letter + name[at + (kind != "put in") :]
