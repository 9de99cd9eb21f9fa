"""Tensions over time: linear between rows, held outside, and only those that a cable can have."""

import numpy as np
import pytest

from continuum.dynamics.tensions import LET_GO, Tensions, slack
from continuum.errors import InvalidValueError

PROFILE = Tensions(np.array([1.0, 2.0, 4.0]), np.array([[0.0, 6.0], [10.0, 6.0], [0.0, 0.0]]))


@pytest.mark.parametrize(
    ("t", "expected"),
    [
        (-5.0, [0.0, 6.0]),
        (1.0, [0.0, 6.0]),
        (1.25, [2.5, 6.0]),
        (2.0, [10.0, 6.0]),
        (3.0, [5.0, 3.0]),
        (4.0, [0.0, 0.0]),
        (99.0, [0.0, 0.0]),
    ],
)
def test_linear_between_rows_and_held_outside(t: float, expected: list[float]) -> None:
    np.testing.assert_allclose(PROFILE.at(t), expected, rtol=1e-15)


def test_a_slack_cable_is_held_by_no_motor() -> None:
    for t in (-1.0, 0.0, 7.0):
        np.testing.assert_array_equal(slack().at(t), [LET_GO, LET_GO])


@pytest.mark.parametrize(
    ("times", "values"),
    [
        ([], np.zeros((0, 2))),
        ([0.0, 0.0], np.zeros((2, 2))),
        ([1.0, 0.0], np.zeros((2, 2))),
        ([0.0, np.nan], np.zeros((2, 2))),
        ([0.0], np.zeros((1, 3))),
        ([0.0, 1.0], np.zeros((1, 2))),
        ([0.0], [[0.0, -1e-9]]),
        ([0.0], [[np.nan, 0.0]]),
        ([0.0, 1.0], [[0.0, 0.0], [0.0]]),
    ],
)
def test_bad_tensions_are_reported(times: object, values: object) -> None:
    with pytest.raises(InvalidValueError, match="allowed"):
        Tensions(times, values)  # type: ignore[arg-type]
