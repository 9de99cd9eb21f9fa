"""Load cells whose zero is a little off show no pull; a cable that pushes is refused."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from continuum.errors import FileError
from continuum.recordings.recording_checks import repaired
from continuum.recordings.samples import Samples

T = np.arange(60) / 120


def samples(least: float) -> Samples:
    """A swing whose second cable shows this tension [N] in the rows 12 and 13."""
    pull = np.stack([np.full(T.size, 5.0), np.zeros(T.size)], axis=1)
    pull[10:12, 1] = least
    return Samples(Path("swing.csv"), np.arange(2, 62), T, 0.3 * np.cos(9 * T)[:, None], None, pull)


@pytest.mark.parametrize("least", [-0.2, -0.19, -1e-9])
def test_a_little_below_zero_is_no_pull_and_reported(least: float) -> None:
    found, notes = repaired(samples(least))
    assert notes == (f"rows 12, 13 with a tension below zero, by {-least:.2g} N at most, set to zero",)
    assert found.pull is not None
    np.testing.assert_array_equal(found.pull, samples(0.0).pull)


def test_nothing_is_reported_of_what_pulls_or_hangs_loose() -> None:
    for least in (0.0, 2.0):
        assert repaired(samples(least))[1] == ()


def test_a_cable_that_pushes_is_refused() -> None:
    with pytest.raises(FileError, match=r"row 12: tension -0.21 N; a cable cannot push, .* by 0.2 N at most"):
        repaired(samples(-0.21))


def test_cells_of_cables_that_hang_loose_all_the_time_pull_nowhere() -> None:
    noise = np.clip(0.05 * np.random.default_rng(0).normal(size=(T.size, 2)), -0.2, 0.2)
    found, (note,) = repaired(replace(samples(0.0), pull=noise))
    assert "slack cables" in note
    assert found.pull is not None
    assert not found.pull.any()
