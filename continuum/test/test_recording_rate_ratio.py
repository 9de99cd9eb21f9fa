"""Angles and rates of different motions: the recordings alone show it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from identification_laws import N

from continuum.recordings.rate_ratio import odd_rates, rate_ratio
from continuum.recordings.recording import Recording


def runs(seed: int = 3, count: int = 3) -> list[Recording]:
    """Swings of an arm of two joints that fade, seen by sensors of 0.15 degrees and 0.6 degrees/s."""
    random, times = np.random.default_rng(seed), np.arange(193) / 120
    found = []
    for number in range(count):
        swings = [(random.uniform(0.1, 0.4), random.uniform(1.0, 3.0), random.uniform(8, 20)) for _ in range(N)]
        theta = np.stack([a * np.exp(-d * times) * np.cos(w * times) for a, d, w in swings], axis=1)
        rate = np.stack(
            [-a * np.exp(-d * times) * (d * np.cos(w * times) + w * np.sin(w * times)) for a, d, w in swings], axis=1
        )
        noise = np.radians([0.15, 0.6])[:, None, None] * random.normal(size=(2, *theta.shape))
        found.append(Recording(f"r{number}", times, theta + noise[0], rate + noise[1]))
    return found


def slow_clock(run: Recording, by: float) -> Recording:
    return replace(run, times=by * run.times)


def scaled_gyros(run: Recording, by: float) -> Recording:
    assert run.theta_rate is not None
    return replace(run, theta_rate=by * run.theta_rate)


@pytest.mark.parametrize("fault", [slow_clock, scaled_gyros])
@pytest.mark.parametrize("by", [0.8, 0.95, 1.05, 1.2])
def test_a_clock_or_a_gain_that_is_off_is_reported(fault: Callable[[Recording, float], Recording], by: float) -> None:
    spoiled = [fault(run, by) for run in runs()]
    ratio, deviation = rate_ratio(spoiled)
    assert ratio * by == pytest.approx(1.0, abs=0.015)
    assert deviation < 0.01
    (output,) = odd_rates(spoiled)
    assert f"{ratio:.2f} times" in output


@pytest.mark.parametrize("seed", range(4))
def test_what_both_show_is_no_fault(seed: int) -> None:
    """Drift, zeros, late sensors, and a gain that is the angle's as well."""
    drift = np.array([0.2, -0.1])
    for run in runs(seed):
        assert run.theta_rate is not None
        for sound in (
            run,
            replace(run, theta=run.theta + 0.3),
            replace(run, theta=run.theta + drift * run.times[:, None], theta_rate=run.theta_rate + drift),
            replace(run, times=run.times + 5.0),
            replace(run, theta=1.3 * run.theta, theta_rate=1.3 * run.theta_rate),
        ):
            assert rate_ratio([sound])[0] == pytest.approx(1.0, abs=0.02)
            assert not odd_rates([sound])


def test_noise_alone_and_no_rates_say_nothing() -> None:
    random = np.random.default_rng(0)
    times = np.arange(120) / 120
    still = Recording("still", times, 0.002 * random.normal(size=(120, N)), 0.02 * random.normal(size=(120, N)))
    assert not odd_rates([still])
    bare = [replace(run, theta_rate=None) for run in runs()]
    assert rate_ratio(bare) == (1.0, np.inf)
    assert not odd_rates(bare)
    assert rate_ratio([bare[0], *runs()]) == rate_ratio(runs())


@pytest.mark.parametrize("every", [1, 3, 5])
def test_few_samples_of_a_swing_are_no_fault(every: int) -> None:
    """Of 24 a second, and of swings of up to three a second."""
    for seed in range(4):
        sparse = [run.rows(slice(None, None, every)) for run in runs(seed)]
        assert not odd_rates(sparse)
        assert abs(rate_ratio(sparse)[0] - 1) < 0.03


def test_slips_between_samples_make_it_less_sure() -> None:
    """What every second sample alone says of six slips, of which each is over after two or three samples."""
    random, times = np.random.default_rng(1), np.arange(9000) / 3000
    rate = np.zeros((times.size, N))
    for joint in range(N):
        for start in random.uniform(0, 2.9, 6):
            slips = (times >= start) & (times < start + random.uniform(0.03, 0.1))
            rate[slips, joint] = random.choice([-1, 1]) * random.uniform(2, 5)
    rows = slice(None, None, 100)
    run = Recording("slips", times[rows], np.cumsum(rate, axis=0)[rows] / 3000, rate[rows])
    ratio, deviation = rate_ratio([run])
    assert deviation > max(abs(rate_ratio([run.rows(slice(i, None, 2))])[0] - ratio) for i in (0, 1)) > 0.1
    assert not odd_rates([run])


def test_one_recording_and_one_joint_that_are_off_are_named() -> None:
    sound = runs(count=8)
    (output,) = odd_rates([*sound[:7], slow_clock(sound[7], 0.9)])
    assert output.startswith("r7: angles change by 1.1")
    one_large = [replace(run, theta_rate=run.theta_rate * [1.0, 1.5]) for run in sound if run.theta_rate is not None]
    assert rate_ratio(one_large, 0) == rate_ratio(sound, 0)
    assert rate_ratio(one_large, 1)[0] == pytest.approx(1 / 1.5, abs=0.02)
    assert odd_rates(one_large)
    outer = [replace(run, theta=run.theta * [1.0, 0.2], theta_rate=run.theta_rate * [1.0, 0.25])
             for run in sound if run.theta_rate is not None]  # fmt: skip
    (output,) = odd_rates(outer)  # one that moves little says little of all
    assert output.startswith("joint 2: angles change by 0.8")
