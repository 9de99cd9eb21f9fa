"""The white noise of a recording at rest: its size is found, and the stated error of that size is the scatter."""

import numpy as np
import pytest

from continuum.estimation.run import Run
from continuum.estimation.sensor_noise import white_noise, white_noise_error

SD = 3e-3
"""Of a measured angle [rad]; above what is taken for the least."""


@pytest.mark.parametrize("n_joints", [1, 2, 3, 5, 20])
@pytest.mark.parametrize("rows", [200, 1000])
def test_the_stated_error_of_the_noise_is_its_scatter(n_joints: int, rows: int) -> None:
    rng, draws = np.random.default_rng(n_joints), 100
    found, stated = np.empty(draws), np.empty(draws)
    for k in range(draws):
        readings = SD * rng.normal(size=(rows, n_joints))
        run = Run(
            "at rest",
            0.01 * np.arange(rows),
            readings,
            np.ones_like(readings),
            n_joints,
            (np.zeros(1), np.zeros((1, 1))),
        )
        found[k], stated[k] = np.sqrt(white_noise([run])[0, 0]) / SD, white_noise_error([run])
    assert np.mean(found) == pytest.approx(1.0, abs=4 * np.std(found) / np.sqrt(draws) + 0.02)
    assert np.std(found) == pytest.approx(np.mean(stated), rel=4 / np.sqrt(2 * draws))
