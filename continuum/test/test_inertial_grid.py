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


def test_missing_readings_are_counted_once_though_two_instants_of_the_grid_lack_them() -> None:
    all_times = np.arange(1000) / 60
    kept = np.delete(all_times, np.arange(5, 995, 10))
    one, other = stream(all_times + 0.3 / 60), stream(kept)
    recording = on_one_grid([one, other])
    assert one.missing == 0.0
    assert other.missing == pytest.approx(0.099, abs=0.001)
    assert np.mean(~recording.valid[:, 1]) == pytest.approx(2 * 0.099, abs=0.003)


def test_a_period_is_exact_though_stamps_are_rounded_to_a_coarse_tick() -> None:
    times = np.rint(np.arange(6000) / 60 * 1e4) / 1e4
    assert stream(times).period == pytest.approx(1 / 60, rel=1e-6)
    assert stream(times).missing == 0.0
