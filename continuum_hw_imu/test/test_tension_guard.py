"""The receiver's rules hold whatever comes, in whatever order; each of them by itself as well."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum_hw_imu.protocol.messages import Cause, GuardState, ReceiverLimits, Result
from continuum_hw_imu.receiver.tension_guard import TensionGuard

TICK = 5_000  # us
LIMITS = ReceiverLimits(max_tension=40.0, max_rate=400.0)
A, B = 11, 22


class Bench:
    """A guard, its clock, and the record of its set points. It begins 100 s after the device's start."""

    def __init__(self, start: int = 100_000_000) -> None:
        self.guard = TensionGuard(LIMITS, 2)
        self.now = start
        self.sequence = 0
        self.record = [self.guard.set_points]

    def run(
        self, seconds: float, *, pull: tuple[float, ...] | None = None, beat: bool = True, token: int = A
    ) -> Result:
        """Let time pass; the last answer."""
        result = Result.DONE
        for _ in range(round(seconds * 1e6 / TICK)):
            if pull is not None:
                result = self.pull(pull, token=token)
            elif beat:
                result = self.guard.heartbeat(token, self.now)
            self.tick()
        return result

    def tick(self) -> None:
        interval = self.guard.move_on(self.now, TICK * 1e-6)
        np.testing.assert_array_equal(interval.before, self.record[-1])
        self.now += TICK
        self.record.append(self.guard.set_points)

    def pull(self, tensions: tuple[float, ...], token: int = A, age: int = 0, sequence: int | None = None) -> Result:
        self.sequence = (self.sequence + 1) % (1 << 16) if sequence is None else sequence
        return self.guard.set_tension(token, self.sequence, (self.now - age) % (1 << 32), tensions, self.now)

    def reset_stop(self, token: int = A, age: int = 0) -> Result:
        return self.guard.reset_stop(token, (self.now - age) % (1 << 32), self.now)

    def seconds_to_slack(self) -> float:
        """How long from now on until no cable pulls, with nobody there."""
        start = self.now
        while self.guard.set_points.any():
            self.tick()
            assert self.now - start < 10_000_000, "never slack"
        return (self.now - start) * 1e-6


@pytest.fixture
def pulling() -> Bench:
    """Claimed by A, at 20 N and 5 N."""
    bench = Bench()
    assert bench.guard.claim(A, bench.now) is Result.DONE
    assert bench.run(0.2, pull=(20.0, 5.0)) is Result.DONE
    assert bench.guard.set_points.tolist() == [20.0, 5.0]
    return bench


STEPS = st.lists(
    st.one_of(
        st.tuples(st.sampled_from(["claim", "release", "beat", "let_go", "reset_stop"]), st.sampled_from([A, B])),
        st.tuples(st.sampled_from(["stop", "lose_link"]), st.just(0)),
        st.tuples(
            st.just("pull"),
            st.tuples(
                st.sampled_from([A, B]),
                st.lists(st.floats(allow_nan=True), min_size=1, max_size=3),
                st.integers(-1_000_000, 2_000_000),
                st.integers(0, 5),
            ),
        ),
        st.tuples(st.just("pass"), st.integers(1, 60)),
    ),
    max_size=60,
)


@settings(max_examples=200)
@given(STEPS, st.sampled_from([100_000_000, (1 << 32) - 300_000]))
def test_limits_hold_whatever_comes(steps, start):
    bench = Bench(start)
    guard, sequence, dropped = bench.guard, 0, set()
    for kind, what in steps:
        before = guard.set_points
        match kind:
            case "pull":
                token, tensions, age, step = what
                sequence += step
                bench.pull(tuple(tensions), token, age, sequence)
            case "pass":
                for _ in range(what):
                    bench.tick()
            case "stop":
                guard.stop(bench.now)
            case "lose_link":
                guard.lose_link()
            case "beat":
                guard.heartbeat(what, bench.now)
            case "reset_stop":
                bench.reset_stop(what)
            case _:
                getattr(guard, kind)(what, bench.now)
        if kind != "pass" and not np.array_equal(before, guard.set_points):
            assert kind in ("stop", "let_go")  # the only ones that change tension at once, and only to zero
            assert not guard.set_points.any()
            dropped.add(len(bench.record))
            bench.record.append(guard.set_points)
        if guard.state is GuardState.STOPPED:
            assert not guard.set_points.any()
    record = np.array(bench.record)
    assert np.all(np.isfinite(record))
    assert record.min() >= 0.0
    assert record.max() <= LIMITS.max_tension
    for k, (earlier, later) in enumerate(pairwise(record), start=1):
        if k not in dropped:
            assert np.all(np.abs(later - earlier) <= LIMITS.max_rate * TICK * 1e-6 + 1e-9)
    assert bench.seconds_to_slack() <= LIMITS.slack_after + 3 * TICK * 1e-6


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


def test_a_commander_that_begins_anew_begins_slack(pulling):
    assert pulling.guard.claim(A, pulling.now) is Result.NOT_SLACK
    assert pulling.guard.cause is Cause.CLAIMED_AGAIN
    pulling.run(LIMITS.slack_time + 0.05)
    assert not pulling.guard.set_points.any()
    assert pulling.guard.claim(A, pulling.now) is Result.DONE


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
def test_age_is_told_by_the_device_s_clock(pulling, age, result):
    pulling.run(1.0, pull=(20.0, 5.0))
    assert pulling.pull((1.0, 1.0), age=age) is result


def test_age_is_told_across_the_clock_s_wrap():
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
