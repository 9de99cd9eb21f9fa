"""The device's clock without its wraps, and without the jitter of the way."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from continuum_hw_imu.emulator.device_clock import DeviceClock
from continuum_hw_imu.protocol.clock_map import ClockMap
from continuum_hw_imu.protocol.device_time import DeviceTime, signed_difference

WRAP = 1 << 32


@example(WRAP, [-(10**9), 2 * 10**9])
@given(st.integers(0, 3 * WRAP), st.lists(st.integers(-(10**9), 2 * 10**9), max_size=50))
def test_wraps_are_followed_forwards_and_back(start, steps):
    clock, real = DeviceTime(), start
    shift = clock.unwrapped(start % WRAP) - start
    newest = start
    for step in steps:
        real = max(newest + step, 0)
        assert clock.unwrapped(real % WRAP) == real + shift
        newest = max(newest, real)


def test_differences_know_of_the_wrap():
    assert signed_difference(5, WRAP - 5) == 10
    assert signed_difference(WRAP - 5, 5) == -10


def streamed(
    clock: ClockMap, random: np.random.Generator, seconds: float, ppm: float, start: float = 0.0
) -> np.ndarray:
    """Errors of the mapped times [s] of frames at 60 Hz with jitter, some of them late by much."""
    errors = []
    for k in range(round(60 * start), round(60 * (start + seconds))):
        device, real = round(k / 60 * 1e6), 5000.0 + k / 60 * (1 + ppm * 1e-6)
        late = 0.2 if random.random() < 0.05 else 0.0
        clock.received(device, real + random.exponential(0.002) + late)
        errors.append(clock.host_time(device) - real)
    return np.array(errors)


@pytest.mark.parametrize("ppm", [-150.0, 0.0, 150.0])
def test_drift_is_found_and_jitter_removed(ppm):
    clock = ClockMap()
    errors = streamed(clock, np.random.default_rng(3), 60.0, ppm)
    assert np.abs(errors[60:]).max() < 1.5e-3
    assert np.abs(errors[1800:]).max() < 1e-4
    assert clock.drift == pytest.approx(ppm * 1e-6, abs=5e-6)
    assert clock.leaps == 0


def test_mapped_times_of_a_row_of_frames_never_go_back():
    clock, random = ClockMap(), np.random.default_rng(4)
    stamps = []
    for k in range(3600):
        clock.received(round(k / 60 * 1e6), k / 60 + random.exponential(0.003))
        stamps.append(clock.host_time(round(k / 60 * 1e6)))
    gaps = np.diff(stamps[60:])
    assert gaps.min() > 1 / 60 - 1e-3
    assert gaps.max() < 1 / 60 + 1e-3
    assert all(a < b for a, b in pairwise(stamps))


def test_a_burst_of_late_frames_changes_nothing():
    clock, random = ClockMap(), np.random.default_rng(5)
    streamed(clock, random, 20.0, 50.0)
    device = 20_000_000
    expected = clock.host_time(device)
    for k in range(300):
        clock.received(device + k * 16667, expected + k / 60 + 0.3)
    assert clock.host_time(device) == pytest.approx(expected, abs=2e-4)


def test_a_change_of_drift_is_followed():
    clock, random = ClockMap(), np.random.default_rng(6)
    streamed(clock, random, 30.0, 0.0)
    for k in range(1800, 5400):
        device, real = round(k / 60 * 1e6), 5000.0 + 30.0 + (k / 60 - 30.0) * (1 - 200e-6)
        clock.received(device, real + random.exponential(0.001))
    assert clock.drift == pytest.approx(-200e-6, abs=5e-6)
    assert clock.host_time(device) == pytest.approx(real, abs=2e-4)


def test_a_clock_that_was_set_begins_again():
    clock = ClockMap()
    for k in range(600):
        clock.received(k * 16667, k / 60)
    for k in range(600, 900):
        clock.received(k * 16667 + 3_000_000, k / 60)
    assert clock.leaps == 1
    assert clock.host_time(900 * 16667 + 3_000_000) == pytest.approx(15.0, abs=1e-3)


@given(st.integers(0, 1 << 32), st.sampled_from([-690.0, -100.0, 0.0, 100.0, 690.0]), st.sampled_from([0.0, 0.02, 0.5]))
def test_a_time_is_never_more_off_than_its_error(seed, ppm, waits):
    """However late frames and requests are read: at first, later, or in waits of a process without a core."""
    clock, random = ClockMap(), np.random.default_rng(seed)
    awake, asked, known = 0.0, 0.0, 0
    for k in range(60 * 12):
        device, real = round(k / 60 * 1e6), 5000.0 + k / 60 * (1 + ppm * 1e-6)
        clock.received(device, max(real + random.exponential(0.001), awake))
        assert abs(clock.host_time(device) - real) <= clock.error(device) + 2e-6
        known += clock.error(device) < 0.01
        if random.random() < 0.3:
            read = real + random.exponential(0.001)
            asked = read - random.exponential(0.001 if random.random() < 0.5 else waits)
            device += round((read - real) / (1 + ppm * 1e-6) * 1e6)
            clock.received(device, max(read + random.exponential(0.001), awake), asked)
            assert abs(clock.host_time(device) - read) <= clock.error(device) + 2e-6
        if random.random() < 0.1:
            awake = real + random.exponential(waits)
    assert known > 60 * 6


@pytest.mark.parametrize("lost", [-0.04, -0.012, -0.006, 0.006, 0.012, 0.04])
def test_a_device_whose_clock_loses_time_is_noticed_at_the_next_answer(lost):
    """As of missed interrupts; nothing tells before the answer, or within the delay of its way."""
    clock, random, delay = ClockMap(), np.random.default_rng(8), 0.002
    for k in range(60 * 40):
        real = 5000.0 + k / 60
        device = round((k / 60 - (lost if k > 1200 else 0.0)) * 1e6)
        clock.received(device, real + random.uniform(0.0, delay), real - random.uniform(0.0, delay))
        if k > 60:
            assert abs(clock.host_time(device) - real) <= clock.error(device) + 2.0 * delay
    assert clock.leaps == 1


def test_no_answer_no_error_is_known():
    clock = ClockMap()
    for k in range(60):
        clock.received(k * 16667, k * 16667e-6)
    assert clock.error(60 * 16667) == np.inf
    clock.received(60 * 16667, 1.0001, 0.9)
    assert clock.error(60 * 16667) == pytest.approx(0.1, abs=2e-3)


def test_there_and_back():
    clock = ClockMap()
    for k in range(1200):
        clock.received(k * 16667, 100.0 + k / 60 * (1 + 1e-4))
    assert clock.device_time(clock.host_time(123_456_789)) == 123_456_789


def test_late_frames_out_of_order_are_no_new_points():
    clock = ClockMap()
    for k in range(600):
        clock.received(k * 16667, k * 16667e-6)
        if k > 100:
            clock.received((k - 90) * 16667, k * 16667e-6)
    assert abs(clock.drift) < 1e-6


def test_a_clock_that_drifts_otherwise_goes_on_from_what_it_shows():
    clock = DeviceClock(10.0, 500, drift=20.0)
    shows = clock.at(13.0)
    assert shows == 500 + 3_000_060
    clock.drift_from(13.0, -50.0)
    assert (clock.at(13.0), clock.at(14.0)) == (shows, shows + 999_950)
    assert clock.real(clock.at(15.0)) == pytest.approx(15.0, abs=1e-6)
