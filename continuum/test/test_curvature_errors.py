"""Errors of medians: the covariance of medians of correlated noise, against drawn samples."""

import numpy as np
import pytest

from continuum.curvature.holds import Hold
from continuum.curvature.median_error import median_errors
from continuum.recordings.recording import Recording

ROWS, DRAWS = 201, 20_000


@pytest.mark.parametrize("correlation", [-0.9, -0.5, 0.0, 0.5, 1.0])
def test_medians_of_correlated_noise_vary_together_as_drawn_samples_do(correlation: float) -> None:
    """Neighbouring joints share a sensor, so that their errors are correlated by about -1/2."""
    noise = 1e-6 * np.array([[1.0, 2.0 * correlation], [2.0 * correlation, 4.0]])
    recording = Recording("rest", np.arange(ROWS) / 120, np.zeros((ROWS, 2)))
    hold = Hold(recording, slice(0, ROWS), np.zeros(2), noise, None, 1)
    stated = median_errors([hold], slow=0.0).covariance(0)

    rows = np.random.default_rng(7).multivariate_normal(np.zeros(2), noise, (DRAWS, ROWS))
    drawn = np.cov(np.median(rows, axis=1).T)
    np.testing.assert_allclose(stated, drawn, rtol=0, atol=0.04 * drawn.max())
