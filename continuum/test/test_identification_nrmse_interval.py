"""The interval of Eq. 19 of one run."""

from __future__ import annotations

import numpy as np
import pytest

from continuum.identification.nrmse import nrmse
from continuum.identification.nrmse_interval import nrmse_interval

MEASURED = np.column_stack([np.sin(np.linspace(0, 20, 400)), np.cos(np.linspace(0, 9, 400)), np.zeros(400)])


def test_an_error_that_is_everywhere_the_same_is_known() -> None:
    wrong = MEASURED + np.array([0.1, -0.2, 0.0])
    low, high = nrmse_interval(wrong, MEASURED, np.random.default_rng(0))
    assert low == pytest.approx(nrmse(wrong, MEASURED)) == high


def test_an_error_of_one_moment_is_hardly_known() -> None:
    wrong = MEASURED.copy()
    wrong[10:30] += 1.0
    low, high = nrmse_interval(wrong, MEASURED, np.random.default_rng(0))
    assert low == 0.0
    assert low < nrmse(wrong, MEASURED) < high


def test_it_holds_the_error_of_longer_runs() -> None:
    """Errors hang together over a tenth of a stretch, of a size that changes from run to run by chance alone."""
    random, held = np.random.default_rng(5), 0
    for _ in range(200):
        pieces = random.normal(0, 0.1, (80, 3)).repeat(5, axis=0)
        low, high = nrmse_interval(MEASURED + pieces, MEASURED, random)
        held += low <= np.mean(0.1 / np.std(MEASURED[:, :2], axis=0)) <= high
    assert 0.85 < held / 200 < 0.99
