"""Stamps of arrival in bursts are refused with the times within and between them; stamps that angles follow are not."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from csv_runs import text_of
from hypothesis import given
from hypothesis import strategies as st
from recorded_runs import write as write_bag
from swing_bag import STAMPS, T, stamped, swing

from continuum.errors import FileError
from continuum.recordings.burst_stamps import refuse_bursts
from continuum.recordings.read_recording import read_recording
from continuum.recordings.recording_checks import repaired
from continuum.recordings.samples import Samples

ROWS = 240


def arrival(times: np.ndarray, size: int, apart: float, jitter: float, seed: int) -> np.ndarray:
    """Stamps of readings that are handed over in bursts, some later than others [s].

    Args:
        times: true times, evenly spaced, (rows,) [s].
        size: readings of a burst.
        apart: time between stamps of a burst, relative to that between readings.
        jitter: by which a burst may be late, relative to the time between bursts.
        seed: of the jitter.
    """
    random, step = np.random.default_rng(seed), times[1] - times[0]
    number = np.arange(times.size)
    last = times[0] + step * (size * (number // size + 1) - 1)  # of a whole burst
    late = size * step * jitter * random.random(number[-1] // size + 1)[number // size]
    between = apart * step * random.uniform(0.7, 1.3, times.size) * (number % size > 0)
    summed = np.cumsum(between)
    return np.asarray(last + late + summed - summed[size * (number // size)])


def motion(times: np.ndarray, noise: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Angles [rad] with noise, and rates [rad/s], of two joints that swing from the start."""
    phase = np.stack([9 * times, 7 * times + 1], axis=1)
    theta = 0.4 * np.cos(phase) + noise * np.random.default_rng(seed).standard_normal((times.size, 2))
    return theta, -0.4 * np.array([9, 7]) * np.sin(phase)


def samples(stamps: np.ndarray, theta: np.ndarray, rates: np.ndarray | None = None) -> Samples:
    return Samples(Path("run.csv"), np.arange(2, stamps.size + 2), stamps, theta, rates, None)


bursts = {
    "size": st.integers(2, 20), "apart": st.floats(0.0, 0.1), "jitter": st.floats(0.0, 0.3), "seed": st.integers(0, 99)
}  # fmt: skip


@given(**bursts, rate=st.floats(80.0, 500.0), noise=st.floats(0.0, 2e-3), with_rates=st.booleans())
def test_stamps_of_arrival_are_refused_with_their_times(
    size: int, apart: float, jitter: float, seed: int, rate: float, noise: float, with_rates: bool
) -> None:
    times = np.arange(ROWS) / rate
    theta, rates = motion(times, noise, seed)
    stamps = arrival(times, size, apart, jitter, seed)
    with pytest.raises(FileError, match="bursts") as refused:
        repaired(samples(stamps, theta, rates if with_rates else None))
    line = str(refused.value)
    rows, within, low = map(float, re.search(r"bursts: (\d+) rows (\S+) ms apart, then none for (\S+) ", line).groups())
    assert rows == size
    steps = 1e3 * np.diff(stamps)
    assert within == pytest.approx(np.median(steps[steps < np.mean(steps) / 2]), rel=0.01, abs=1e-3)
    assert np.min(steps[steps >= np.mean(steps) / 2]) <= low * 1.01
    said = float(re.search(r"([\d.e+]+) a second on average", line)[1])
    assert said == pytest.approx((ROWS - 1) / (stamps[-1] - stamps[0]), rel=1e-3)


@given(**bursts, noise=st.floats(0.0, 5e-4))
def test_stamps_that_the_angles_follow_are_kept(
    size: int, apart: float, jitter: float, seed: int, noise: float
) -> None:
    """Readings may be taken in bursts, too."""
    stamps = arrival(np.arange(ROWS) / 120, size, 0.02 + apart, jitter, seed)
    found, _ = repaired(samples(stamps, motion(stamps, noise, seed)[0]))
    np.testing.assert_array_equal(found.times, stamps[np.isin(stamps, found.times)])
    assert found.times.size > 0.9 * ROWS


@pytest.mark.parametrize("size", [2, 5, 20])
def test_right_stamps_of_slow_noisy_motion_are_kept(size: int) -> None:
    """All but one in a hundred; where the motion is less than the noise, angles tell no clock."""
    refused, random = 0, np.random.default_rng(size)
    for seed in range(200):
        stamps = arrival(np.arange(ROWS) / 120, size, 0.05, 0.2, seed)
        theta = 0.02 * np.sin(np.outer(stamps, [1.0, 1.5])) + 2e-3 * random.standard_normal((ROWS, 2))
        try:
            refuse_bursts(samples(stamps, theta))
        except FileError:
            refused += 1
    assert refused <= 6  # 1 in 100 gives more in 1 of 200 tests


@given(st.floats(0.0, 0.4), st.integers(0, 99), st.floats(60.0, 1000.0))
def test_stamps_with_little_jitter_are_kept(jitter: float, seed: int, rate: float) -> None:
    times = np.arange(ROWS) / rate
    stamps = times + jitter / rate * np.random.default_rng(seed).uniform(-0.5, 0.5, ROWS)
    assert repaired(samples(stamps, motion(times, 1e-3, seed)[0]))[1] == ()


@pytest.mark.parametrize("lost", [lambda k: k % 20 < 8, lambda k: k % 3 == 1, lambda k: k % 7 > 1])
def test_lost_rows_are_no_bursts(lost: Callable[[np.ndarray], np.ndarray]) -> None:
    times = np.arange(3 * ROWS) / 240
    kept = ~lost(np.arange(times.size))
    found, notes = repaired(samples(times[kept], motion(times, 1e-3, 0)[0][kept]))
    assert (found.times.size, notes) == (np.count_nonzero(kept), ())


def test_tables_and_messages_are_refused_alike(tmp_path: Path) -> None:
    stamps = arrival(T, 5, 0.04, 0.1, 3)
    topics = swing()
    for one, stamp in zip(topics["/joint_states"], stamps, strict=True):
        stamped(one, int(STAMPS[0] + 1e9 * stamp))
    theta, _ = motion(T, 0.0, 0)
    file = tmp_path / "run.csv"
    columns = {"t_s": stamps, "q1_rad": theta[:, 0], "q2_rad": theta[:, 1]}
    file.write_text(text_of({name: [f"{one:.7f}" for one in values] for name, values in columns.items()}))
    for path, word in ((file, "rows"), (write_bag(tmp_path / "run", topics), "messages")):
        with pytest.raises(FileError, match=rf"5 {word} 0\.\d+ ms apart"):
            read_recording(path)
