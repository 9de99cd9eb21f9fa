"""Numbers as text with a few significant digits: accurate to half of the last digit, and without an exponent."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.significant_digits import rounded


@given(st.floats(1.001e-4, 9.99e5), st.integers(1, 4), st.sampled_from([1.0, -1.0]))
def test_numbers_of_usual_size_are_rounded_without_an_exponent(size: float, digits: int, sign: float) -> None:
    text = rounded(sign * size, digits)
    assert "e" not in text or float(text) == sign * 1e6
    assert float(text) == pytest.approx(sign * size, rel=0.501 * 10 ** (1 - digits))


@given(st.floats(1e-3, 1e3))
def test_positive_numbers_show_their_sign_if_asked(size: float) -> None:
    assert rounded(size, 3, "+") == f"+{rounded(size, 3)}"
