"""Streams of sensors on one grid: times that cannot be true are refused before they take all memory."""

import numpy as np
import pytest

from continuum.errors import MeasurementError
from continuum.inertial.time_grid import Stream, on_one_grid


def stream(times: np.ndarray) -> Stream:
    k = times.size
    return Stream("sensor", times, np.zeros((k, 3)), np.zeros((k, 3)), np.zeros(k, dtype=bool))


def test_a_few_readings_far_apart_are_damaged_and_no_grid_of_millions() -> None:
    damaged = np.concatenate([np.arange(7) * 1e-6, [50.0, 100.0, 150.0]])
    with pytest.raises(MeasurementError, match="their times are damaged"):
        on_one_grid([stream(damaged)])


def test_long_pauses_are_missing_readings() -> None:
    times = np.concatenate([np.arange(200), np.arange(2000, 2200)]) / 60
    recording = on_one_grid([stream(times)])
    assert recording.times.size == 2200
    assert np.sum(recording.valid) == 400
