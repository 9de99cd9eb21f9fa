"""Misspelt names: those that one letter separates from a word are suggested, and nothing of what is not known."""

import re

from edits import LETTERS, misspelt
from hypothesis import assume, given
from hypothesis import strategies as st

from continuum.did_you_mean import did_you_mean


def suggested(text: str) -> list[str]:
    found = re.fullmatch(r"; did you mean (.+)\?", text)
    return found[1].split(" or ") if found else []


@given(st.sets(st.text(LETTERS, min_size=5, max_size=12), min_size=1, max_size=3), st.data())
def test_every_near_name_is_suggested(names: set[str], data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(sorted(names)))
    assert name in suggested(did_you_mean(data.draw(misspelt(name)), names))


def test_names_that_are_equally_near_are_all_suggested() -> None:
    assert suggested(did_you_mean("--hosd", ["--hold", "--host", "--model"])) == ["--host", "--hold"]


@given(st.text(max_size=8), st.sets(st.text(LETTERS, min_size=1, max_size=8), max_size=4))
def test_nothing_else_is_suggested(word: str, names: set[str]) -> None:
    assume(not {*word} & {*LETTERS})
    assert did_you_mean(word, names) == ""
