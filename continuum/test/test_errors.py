"""Errors keep what they tell, also from one process to another, which take them apart as a copy does."""

from __future__ import annotations

from copy import copy

import pytest

from continuum.errors import ContinuumError, FileError, InvalidValueError, MeasurementError

ERRORS = [
    InvalidValueError("theta", -4.0, "-pi to pi rad"),
    FileError("runs/1.csv", "line 3 has no columns"),
    MeasurementError("the arm moves"),
]


@pytest.mark.parametrize("error", ERRORS)
def test_an_error_that_is_sent_on_arrives_as_it_is(error: ContinuumError) -> None:
    arrived = copy(error)
    assert type(arrived) is type(error)
    assert str(arrived) == str(error)
    assert vars(arrived) == vars(error)


@pytest.mark.parametrize("error", [InvalidValueError("a\nb", 1, "c\u2028d"), FileError("x\ry", "has \x1b[31m")])
def test_a_message_is_one_line_that_can_be_printed(error: ContinuumError) -> None:
    assert str(error).isprintable()
