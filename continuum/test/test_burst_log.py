"""Faults: each is counted, and a burst takes few lines of the log."""

import pytest

from continuum.burst_log import BurstLog


class Clock:
    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock():
    return Clock()


def test_first_event_is_reported_at_once_and_the_rest_once_it_is_quiet(clock):
    lines = []
    log = BurstLog(lines.append, clock, prefix="dropped, ")
    for i in range(50):
        log.note("not finite", f"position[{i}] is nan")
        clock.now += 0.01
        log.tick()
    assert lines == ["dropped, not finite: position[0] is nan"]
    clock.now += 1.0
    log.tick()
    assert lines[1:] == ["dropped, not finite: 50 in 0.5 s, the last: position[49] is nan"]
    assert log.counts == {"not finite": 50}


def test_single_event_has_no_summary(clock):
    lines = []
    log = BurstLog(lines.append, clock)
    log.note("wrong length", "x")
    clock.now += 10.0
    log.tick()
    assert len(lines) == 1


def test_long_burst_is_summed_up_now_and_then(clock):
    lines = []
    log = BurstLog(lines.append, clock, every=5.0)
    for _ in range(200):
        log.note("not finite", "x")
        clock.now += 0.1
        log.tick()
    assert 3 <= len(lines) <= 5
    assert log.total == 200


def test_next_burst_is_reported_again(clock):
    lines = []
    log = BurstLog(lines.append, clock)
    for _ in range(2):
        log.note("not finite", "x")
        clock.now += 1.5
    log.tick()
    assert lines == ["not finite: x"] * 2


def test_causes_are_bursts_of_their_own(clock):
    lines = []
    log = BurstLog(lines.append, clock)
    log.note("not finite", "x")
    log.note("wrong length", "y")
    assert len(lines) == 2
    assert log.total == 2


def test_several_events_at_once_count_as_many(clock):
    lines = []
    log = BurstLog(lines.append, clock)
    for events in (2, 3):
        log.note("lost", "frames", events)
        clock.now += 0.5
    clock.now += 1.0
    log.tick()
    assert lines[1:] == ["lost: 5 in 0.5 s, the last: frames"]
    assert log.counts == {"lost": 5}
