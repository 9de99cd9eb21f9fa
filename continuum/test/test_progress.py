"""The time that is left: of what is over, and none of too little."""

from __future__ import annotations

import re

from hypothesis import given
from hypothesis import strategies as st

from continuum.cli.progress import left_in_words


def seconds(text: str) -> float:
    """What a text states; 0 where it states nothing."""
    found = [float(one) for one in re.findall(r"\d+", text)]
    return sum(value * unit for value, unit in zip(reversed(found), (1, 60), strict=False))


@given(st.floats(0, 1), st.floats(0, 1e4))
def test_what_is_left_takes_as_long_as_what_is_over(part: float, elapsed: float) -> None:
    output = seconds(left_in_words(part, elapsed))
    if part <= 0.1:
        assert output == 0
    else:
        assert 0 <= elapsed * (1 - part) / part - output < 1
