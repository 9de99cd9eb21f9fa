"""Whatever is commanded, and whenever: tension stays within its limits, and is slack in time when commands stop."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.live.tension_limit import TensionLimiter, TensionLimits

TICK = 1 / 120
LIMITS = TensionLimits(max_tension=40.0, max_rate=200.0, patience=0.5, slack_time=0.25)
COMMANDS = st.lists(
    st.none() | st.just("release") | st.tuples(st.floats(0, 1e6), st.floats(0, 1e6)), min_size=1, max_size=200
)


def advanced(follower: TensionLimiter, start: float, ticks: int) -> list[np.ndarray]:
    return [follower.move_on(start + i * TICK, TICK).after for i in range(ticks)]


@given(COMMANDS)
def test_limits_hold_whatever_is_commanded(commands):
    limits = replace(LIMITS, max_tension=4.0)  # reached within three ticks
    follower = TensionLimiter(limits, 2)
    before = np.zeros(2)
    for i, command in enumerate(commands):
        if command == "release":
            follower.release()
            before = np.zeros(2)
        elif command is not None:
            follower.command(np.array(command), i * TICK)
        interval = follower.move_on(i * TICK, TICK)
        np.testing.assert_array_equal(interval.before, before)
        assert np.all((interval.after >= 0) & (interval.after <= limits.max_tension))
        assert np.all(np.abs(interval.after - before) <= limits.max_rate * TICK * (1 + 1e-9))
        before = interval.after


@given(st.floats(1, 1e3), st.floats(1, 1e3), st.integers(0, 30))
def test_slack_in_time_when_commands_stop(first, second, ticks):
    follower = TensionLimiter(LIMITS, 2)
    follower.command(np.array([first, second]), 0.0)
    tight = advanced(follower, 0.0, ticks)
    rest = advanced(follower, ticks * TICK, 120)
    assert follower.abandoned
    until = round((LIMITS.patience + LIMITS.slack_time) / TICK) - ticks + 2
    assert not np.any(rest[until:])
    assert all(np.all(later <= earlier + 1e-12) for earlier, later in pairwise(rest[60:]))
    assert not tight or np.all(tight[-1] > 0)


def test_tension_is_held_while_commands_come_and_reaches_what_is_asked():
    follower = TensionLimiter(LIMITS, 2)
    for i in range(240):
        follower.command(np.array([25.0, 3.0]), i * TICK)
        follower.move_on(i * TICK, TICK)
    np.testing.assert_allclose(follower.tension, [25.0, 3.0])
    assert not follower.abandoned


def test_a_command_after_the_end_pulls_again():
    follower = TensionLimiter(LIMITS, 2)
    follower.command(np.array([10.0, 0.0]), 0.0)
    advanced(follower, 0.0, 100)
    assert follower.abandoned
    follower.command(np.array([10.0, 0.0]), 100 * TICK)
    assert not follower.abandoned
    assert advanced(follower, 100 * TICK, 30)[-1] == pytest.approx([10.0, 0.0])


def test_slack_that_nobody_commands_is_not_reported():
    follower = TensionLimiter(LIMITS, 2)
    follower.command(np.zeros(2), 0.0)
    advanced(follower, 0.0, 200)
    assert not follower.abandoned


def test_a_clock_that_went_back_lets_go():
    follower = TensionLimiter(LIMITS, 2)
    follower.command(np.array([10.0, 0.0]), 1000.0)
    advanced(follower, 1000.0, 30)
    follower.forget_time()
    assert not np.any(advanced(follower, 3.0, 40)[-1])


def test_a_slack_time_of_zero_is_at_once():
    follower = TensionLimiter(replace(LIMITS, slack_time=0.0), 2)
    follower.command(np.array([5.0, 1.0]), 0.0)
    advanced(follower, 0.0, 10)
    follower.abandon()
    np.testing.assert_array_equal(follower.move_on(10 * TICK, TICK).after, 0.0)
    np.testing.assert_array_equal(follower.move_on(11 * TICK, TICK).after, 0.0)
    assert follower.abandoned
