"""What a joint is doing, where it turned back, and how wrong free runs are there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from discovery_verdicts import score
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.motion_phases import PHASES, errors_by_phase, phases
from continuum.discovery.turns import way_since_turn
from continuum.dynamics.reading import Reading
from continuum.identification.recording import Recording

TIMES = np.arange(0, 3.0, 1 / 120)
SWING = 2 * np.pi * 0.5  # rad/s


def recording(theta: np.ndarray, rates: bool = True) -> Recording:
    return Recording("run", TIMES, theta, np.gradient(theta, TIMES, axis=0) if rates else None)


def a_swing_and_a_rest() -> np.ndarray:
    """One joint swings for 2 s from one side to the other and back, then stays; another one never moves."""
    swinging = np.where(TIMES < 2.0, np.cos(SWING * TIMES), 1.0)
    return np.column_stack([swinging, np.zeros(TIMES.size)])


@pytest.mark.parametrize("rates", [True, False])
def test_what_a_swinging_joint_does(rates: bool) -> None:
    now = np.array(PHASES)[phases(recording(a_swing_and_a_rest(), rates))]
    assert set(now[:, 1]) == {"at rest"}
    at = {t: now[np.argmin(np.abs(TIMES - t)), 0] for t in (0.25, 0.75, 1.0, 1.25, 1.75, 2.5)}
    assert at == {
        0.25: "speeding up", 0.75: "slowing down", 1.0: "turning back", 1.25: "speeding up", 1.75: "slowing down",
        2.5: "at rest",
    }  # fmt: skip


def test_a_joint_that_rests_between_two_ways_has_not_turned_back() -> None:
    halts = np.interp(TIMES, [0, 0.5, 0.7, 1.2, 3.0], [0.0, 0.5, 0.5, 0.0, 0.0])[:, None]
    assert "turning back" not in np.array(PHASES)[phases(recording(halts))]


def test_a_joint_that_creeps_rests() -> None:
    """Below 0.1 rad/s."""
    creeping, going = phases(recording(np.column_stack([0.07 * TIMES, 0.13 * TIMES]))).T
    assert np.all(creeping == PHASES.index("at rest"))
    assert not np.any(going == PHASES.index("at rest"))


def test_errors_are_told_where_they_are() -> None:
    run = recording(a_swing_and_a_rest())
    wrong = np.where(phases(run) == PHASES.index("slowing down"), 0.02, 0.0)
    one = replace(score("run", 0.1), recording=run, seen=Reading(run.times, run.theta + wrong, run.theta_rate, 0.0))
    right = replace(one, seen=Reading(run.times, run.theta, run.theta_rate, 0.0))
    found, better = errors_by_phase([one, one], [right, replace(one, seen=None)])
    assert found[PHASES.index("slowing down"), 0] == pytest.approx(0.02)
    assert found[PHASES.index("speeding up"), 0] == 0.0
    assert np.isnan(found[PHASES.index("turning back"), 1])
    assert np.nanmax(better) == 0.0
    assert np.all(np.isnan(errors_by_phase([replace(one, seen=None)], [one])))


@pytest.mark.parametrize("rate", [60, 100, 120, 200])
@pytest.mark.parametrize(("size", "frequency"), [(0.8, 1.5), (0.5, 2.0), (0.3, 0.5)])
def test_every_turn_is_told_however_quick_and_however_often_sampled(size: float, frequency: float, rate: int) -> None:
    times = np.arange(0, 4.0, 1 / rate)
    theta = size * np.cos(2 * np.pi * frequency * times)[:, None]
    slope = -2 * np.pi * frequency * size * np.sin(2 * np.pi * frequency * times)[:, None]
    turning = phases(Recording("run", times, theta, slope))[:, 0] == PHASES.index("turning back")
    turns = np.arange(1, 2 * frequency * times[-1]) / (2 * frequency)
    assert all(turning[np.argmin(np.abs(times - turn))] for turn in turns)
    assert np.mean(turning) == pytest.approx(0.1 * turns.size / 4.0, rel=0.25)


ANGLES = st.lists(st.floats(-2, 2), min_size=2, max_size=40)


@given(ANGLES, st.floats(-1, 1))
def test_ways_know_no_side_and_no_zero(angles: list[float], shift: float) -> None:
    theta = np.array(angles)[:, None]
    way = way_since_turn(theta)
    np.testing.assert_allclose(way_since_turn(-theta), way)
    assert np.all(way >= 0)
    assert np.all(way <= np.ptp(theta) + 1e-12)
    if np.min(np.abs(np.abs(np.diff(theta, axis=0)) - 0.01)) > 1e-6:
        assert np.mean(np.abs(way_since_turn(theta + shift) - way) < 1e-9) > 0.5


def test_a_way_begins_where_the_joint_turned_back() -> None:
    out, back = np.linspace(0, 1, 50), np.linspace(1, 0.4, 30)[1:]
    way = way_since_turn(np.concatenate([out, back])[:, None])[:, 0]
    np.testing.assert_allclose(way[:50], out)
    np.testing.assert_allclose(way[50:], 1 - back, atol=1e-12)


def test_a_joint_that_is_seen_seldom_has_turned_where_it_was_seen_last() -> None:
    np.testing.assert_allclose(way_since_turn(np.array([[0.0], [0.1], [-0.1]]))[:, 0], [0.0, 0.1, 0.2])


def test_noise_is_no_turn() -> None:
    noisy = np.linspace(0, 1, 200) + np.random.default_rng(3).uniform(-0.004, 0.004, 200)
    np.testing.assert_allclose(way_since_turn(noisy[:, None])[:, 0], np.linspace(0, 1, 200), atol=0.02)
