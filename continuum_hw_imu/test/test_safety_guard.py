"""The receiver's rules, each by itself."""

import numpy as np
import pytest
from guarded_bench import LIMITS, TICK, A, B, Bench

from continuum_hw_imu.protocol.messages import Cause, GuardState, Result


@pytest.fixture
def pulling() -> Bench:
    """Claimed by A, at 20 N and 5 N."""
    bench = Bench()
    assert bench.guard.claim(A, bench.now) is Result.DONE
    assert bench.run(0.2, pull=(20.0, 5.0)) is Result.DONE
    assert bench.guard.set_points.tolist() == [20.0, 5.0]
    return bench


def test_it_starts_slack_with_nobody_in_command():
    bench = Bench()
    assert bench.pull((10.0, 10.0)) is Result.NOT_COMMANDER
    bench.run(1.0, beat=False)
    assert not np.any(bench.record)
    assert bench.guard.state is GuardState.SLACK


def test_one_commands_at_a_time(pulling):
    assert pulling.guard.claim(B, pulling.now) is Result.BUSY
    assert pulling.pull((30.0, 30.0), token=B) is Result.NOT_COMMANDER
    assert pulling.guard.heartbeat(B, pulling.now) is Result.NOT_COMMANDER
    assert pulling.guard.release(B, pulling.now) is Result.NOT_COMMANDER
    assert pulling.guard.let_go(B, pulling.now) is Result.NOT_COMMANDER
    assert pulling.reset_stop(B) is Result.NOT_COMMANDER
    pulling.run(0.3, pull=(20.0, 5.0))
    assert pulling.guard.set_points.tolist() == [20.0, 5.0]


def test_without_heartbeats_the_claim_ends_and_the_cables_are_slack_in_time(pulling):
    assert pulling.seconds_to_slack() <= LIMITS.heartbeat_timeout + LIMITS.slack_time + 2 * TICK * 1e-6
    assert not pulling.guard.claimed
    assert pulling.guard.cause is Cause.HEARTBEATS_STOPPED


def test_heartbeats_alone_do_not_hold_tension(pulling):
    pulling.run(LIMITS.command_timeout - 0.02)
    assert pulling.guard.set_points.any()
    pulling.run(LIMITS.slack_time + 0.04)
    assert not pulling.guard.set_points.any()
    assert pulling.guard.claimed
    assert pulling.guard.cause is Cause.COMMANDS_STOPPED


def test_the_way_down_is_a_straight_line(pulling):
    pulling.guard.lose_link()
    assert pulling.guard.state is GuardState.LETTING_GO
    assert pulling.seconds_to_slack() == pytest.approx(LIMITS.slack_time, abs=2 * TICK * 1e-6)
    falls = np.diff(np.array(pulling.record[-90:-5]), axis=0)
    np.testing.assert_allclose(falls, np.broadcast_to(-np.array([20.0, 5.0]) * TICK * 1e-6 / 0.5, falls.shape))
    assert pulling.guard.cause is Cause.LINK_LOST


def test_letting_go_twice_takes_no_longer(pulling):
    pulling.guard.release(A, pulling.now)
    pulling.run(0.25, beat=False)
    pulling.guard.lose_link()
    assert pulling.seconds_to_slack() <= 0.25 + 2 * TICK * 1e-6


def test_nobody_claims_before_all_is_slack(pulling):
    pulling.guard.release(A, pulling.now)
    pulling.tick()
    assert pulling.guard.claim(B, pulling.now) is Result.NOT_SLACK
    pulling.seconds_to_slack()
    assert pulling.guard.claim(B, pulling.now) is Result.DONE
    pulling.run(0.1, token=B)
    assert not pulling.guard.set_points.any()


def test_a_commander_that_begins_again_begins_slack(pulling):
    assert pulling.guard.claim(A, pulling.now) is Result.NOT_SLACK
    assert pulling.guard.cause is Cause.CLAIMED_AGAIN
    pulling.run(LIMITS.slack_time + 0.05)
    assert not pulling.guard.set_points.any()
    assert pulling.guard.claim(A, pulling.now) is Result.DONE


def test_a_claim_that_comes_twice_makes_nothing_older():
    """As on a slow line, where the second sending was under way when the first was answered."""
    bench = Bench()
    assert bench.guard.claim(A, bench.now) is Result.DONE
    bench.run(0.1)
    assert bench.guard.claim(A, bench.now) is Result.DONE
    assert bench.reset_stop(age=50_000) is Result.DONE  # decided between the two
    assert bench.pull((5.0, 5.0)) is Result.DONE


def test_a_claim_after_commands_begins_again(pulling):
    pulling.run(0.2, pull=(0.0, 0.0))
    assert pulling.guard.claim(A, pulling.now) is Result.DONE
    assert pulling.pull((5.0, 5.0), age=10_000) is Result.STALE  # from before the claim


@pytest.mark.parametrize(
    ("age", "result"),
    [
        (0, Result.DONE),
        (100_000, Result.DONE),
        (501_000, Result.STALE),
        (-1_000, Result.STALE),
        (1 << 31, Result.STALE),
    ],
)
def test_age_is_reported_by_the_device_s_clock(pulling, age, result):
    pulling.run(1.0, pull=(20.0, 5.0))
    assert pulling.pull((1.0, 1.0), age=age) is result


def test_age_is_reported_across_the_clock_s_wrap():
    bench = Bench((1 << 32) - 50_000)
    bench.guard.claim(A, bench.now)
    bench.run(0.2, beat=True)
    assert bench.pull((1.0, 1.0), age=100_000) is Result.DONE


def test_the_age_of_a_command_counts_into_how_long_it_holds(pulling):
    pulling.pull((20.0, 5.0), age=400_000 - 200_000)
    pulling.run(0.31)
    assert pulling.guard.state is GuardState.LETTING_GO


def test_what_was_decided_before_the_claim_does_not_count():
    bench = Bench()
    bench.run(1.0, beat=False)
    bench.guard.claim(A, bench.now)
    assert bench.pull((10.0, 10.0), age=TICK) is Result.STALE
    assert bench.pull((10.0, 10.0)) is Result.DONE


def test_a_command_that_was_overtaken_is_refused(pulling):
    newest = pulling.sequence
    for sequence in (newest, newest - 1, (newest + 40_000) % (1 << 16)):
        assert pulling.pull((30.0, 30.0), sequence=sequence) is Result.OUT_OF_ORDER
    assert pulling.pull((30.0, 30.0), sequence=newest + 1) is Result.DONE


@pytest.mark.parametrize(
    "tensions", [(1.0,), (1.0, 2.0, 3.0), (-1.0, 0.0), (float("nan"), 0.0), (float("inf"), 0.0)], ids=str
)
def test_what_is_no_tension_for_each_cable_is_refused(pulling, tensions):
    assert pulling.pull(tensions) is Result.REFUSED
    pulling.tick()
    assert pulling.guard.set_points.tolist() == [20.0, 5.0]


def test_above_the_limit_means_the_limit(pulling):
    assert pulling.run(0.5, pull=(500.0, 5.0)) is Result.LIMITED
    assert pulling.guard.set_points.tolist() == [40.0, 5.0]


def test_a_stop_is_at_once_and_stays(pulling):
    pulling.guard.stop(pulling.now)
    assert not pulling.guard.set_points.any()
    pulling.record.append(pulling.guard.set_points)
    assert pulling.run(1.0, pull=(20.0, 5.0)) is Result.STOPPED
    assert not pulling.guard.set_points.any()
    assert pulling.guard.state is GuardState.STOPPED


def test_a_stop_outlives_claims_and_links(pulling):
    pulling.guard.stop(pulling.now)
    pulling.record.append(pulling.guard.set_points)
    pulling.guard.lose_link()
    pulling.run(1.0, beat=False)
    assert pulling.guard.claim(B, pulling.now) is Result.DONE
    assert pulling.pull((5.0, 5.0), token=B) is Result.STOPPED
    assert pulling.guard.cause is Cause.STOP


def test_after_a_reset_only_what_is_decided_then_pulls(pulling):
    pulling.guard.stop(pulling.now)
    pulling.record.append(pulling.guard.set_points)
    pulling.run(0.5)
    assert pulling.reset_stop(A) is Result.DONE
    pulling.run(0.1)
    assert not pulling.guard.set_points.any()
    assert pulling.pull((5.0, 5.0), age=150_000) is Result.STALE
    assert pulling.pull((5.0, 5.0)) is Result.DONE
    pulling.run(0.1)
    assert pulling.guard.set_points.tolist() == [5.0, 5.0]


@pytest.mark.parametrize(("wait", "age"), [(0.1, 0.2), (2.0, 0.6)])
def test_no_word_from_before_a_stop_or_from_long_ago_ends_it(pulling, wait, age):
    pulling.guard.stop(pulling.now)
    pulling.record.append(pulling.guard.set_points)
    pulling.run(wait)
    assert pulling.reset_stop(age=round(age * 1e6)) is Result.STALE
    assert pulling.guard.state is GuardState.STOPPED


def test_letting_go_is_at_once_and_does_not_stay(pulling):
    assert pulling.guard.let_go(A, pulling.now) is Result.DONE
    assert not pulling.guard.set_points.any()
    pulling.record.append(pulling.guard.set_points)
    assert pulling.pull((5.0, 5.0), age=TICK) is Result.STALE
    assert pulling.run(0.1, pull=(5.0, 5.0)) is Result.DONE
    assert pulling.guard.set_points.tolist() == [5.0, 5.0]
