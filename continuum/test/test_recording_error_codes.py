"""A number that no arm has is an error code where it stands alone, and a sign of another unit where it does not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from continuum.errors import FileError
from continuum.recordings.recording_checks import repaired
from continuum.recordings.samples import Samples

T = np.arange(120) / 120
SWING = Samples(
    Path("swing.csv"),
    np.arange(2, 122),
    T,
    0.3 * np.cos(9 * T)[:, None],
    -2.7 * np.sin(9 * T)[:, None],
    np.stack([4 + 3 * np.cos(9 * T), 4 - 3 * np.cos(9 * T)], axis=1),
)
CODES = [("theta", 5.2), ("theta", -9999.0), ("rate", 1e308), ("pull", 1e300)]


def spoiled(block: str, rows: slice, value: float) -> Samples:
    values = getattr(SWING, block).copy()
    values[rows, 0] = value
    return replace(SWING, **{block: values})


@pytest.mark.parametrize(("block", "value"), CODES)
def test_a_few_are_left_out_and_named(block: str, value: float) -> None:
    found, notes = repaired(spoiled(block, slice(40, 42), value))
    assert notes == ("rows 42, 43 with a value that no arm has, left out",)
    assert found.times.size == T.size - 2


def test_few_that_all_others_lead_up_to_are_of_another_unit() -> None:
    grown = replace(SWING, theta=SWING.theta * 3.15 / 0.3, rate=None)
    with pytest.raises(FileError, match=r"row 2, q1: a joint angle of 3\.15 rad; .* degrees taken for radians"):
        repaired(grown)
