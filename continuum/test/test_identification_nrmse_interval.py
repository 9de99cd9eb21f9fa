"""The interval of Eq. 19 of one run."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from continuum.identification.nrmse import nrmse
from continuum.identification.nrmse_interval import nrmse_interval

N_TIMES = 400
TIMES = np.linspace(0, 20, N_TIMES)
MEASURED = np.column_stack([np.sin(TIMES), np.cos(0.45 * TIMES), np.zeros(N_TIMES)])


def test_an_error_that_is_everywhere_the_same_is_known() -> None:
    wrong = MEASURED + np.array([0.1, -0.2, 0.0])
    assert nrmse_interval(wrong, MEASURED) == pytest.approx((nrmse(wrong, MEASURED),) * 2)
    assert nrmse_interval(MEASURED, MEASURED) == (0.0, 0.0)


def test_an_error_of_one_moment_is_hardly_known() -> None:
    wrong = MEASURED.copy()
    wrong[10:30] += 1.0
    low, high = nrmse_interval(wrong, MEASURED)
    assert low < nrmse(wrong, MEASURED) / 2
    assert high > 2 * nrmse(wrong, MEASURED)


def test_of_joints_that_never_move_nothing_is_known() -> None:
    assert np.all(np.isnan(nrmse_interval(MEASURED, 0 * MEASURED)))


@pytest.mark.parametrize(("together", "least"), [(1, 0.92), (10, 0.9), (25, 0.85)])
def test_it_holds_the_error_of_longer_runs(together: int, least: float) -> None:
    """Errors that hang together over so many samples: up to half a stretch, where it holds a little less often."""
    random, keep, held = np.random.default_rng(5), np.exp(-1 / together), []
    true = np.mean(0.1 / np.std(MEASURED[:, :2], axis=0))
    for _ in range(300):
        noise = random.normal(0, 0.1 * np.sqrt(1 - keep**2), (N_TIMES + 200, 3))
        errors = lfilter([1.0], [1.0, -keep], noise, axis=0)[200:]
        low, high = nrmse_interval(MEASURED + errors, MEASURED)
        held.append(low <= true <= high)
    assert least < np.mean(held) < 0.99
