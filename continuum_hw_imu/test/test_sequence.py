"""From numbers to losses: against a count by hand over what was sent, hurt and received."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum_hw_imu.protocol.sequence import Arrival, SequenceTracker

FATES = st.lists(st.sampled_from(["comes", "lost", "twice", "late"]), max_size=200)


@given(FATES, st.integers(0, 0xFFFF))
def test_losses_repeats_and_late_ones_are_counted_as_they_were_made(fates, start):
    fates = ["comes", *fates, "comes"]
    tracker = SequenceTracker()
    delayed: list[int] = []
    kinds = []
    for k, fate in enumerate(fates):
        number = (start + k) % 0x10000
        if fate == "late":
            delayed.append(number)
        elif fate != "lost":
            kinds += [tracker.take(number) for _ in range(1 + (fate == "twice"))]
    kinds += [tracker.take(number) for number in delayed]
    assert tracker.lost == fates.count("lost")
    assert tracker.repeated == fates.count("twice") == kinds.count(Arrival.REPEATED)
    assert tracker.late == fates.count("late") == kinds.count(Arrival.LATE)


def test_a_late_one_that_comes_again_is_a_repeat():
    tracker = SequenceTracker()
    assert [tracker.take(n) for n in (1, 3, 2, 2, 3)] == ["new", "new", "late", "repeated", "repeated"]


@pytest.mark.parametrize("leap", [30000, 40000, 65000])
def test_a_sender_that_begins_again_loses_nothing(leap):
    tracker = SequenceTracker()
    tracker.take(100)
    assert tracker.take((100 + leap) % 0x10000) is Arrival.NEW
    assert tracker.take((101 + leap) % 0x10000) is Arrival.NEW
    assert tracker.lost == 0


def test_gaps_longer_than_what_is_remembered_are_counted_whole():
    tracker = SequenceTracker()
    tracker.take(0)
    tracker.take(1000)
    assert tracker.lost == 999
    assert tracker.take(999) is Arrival.LATE


def test_what_is_forgotten_leaves_no_gap():
    tracker = SequenceTracker()
    tracker.take(7)
    tracker.forget()
    tracker.take(3000)
    assert tracker.lost == 0
