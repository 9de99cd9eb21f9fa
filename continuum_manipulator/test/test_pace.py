"""Whatever the clock does, every instant is simulated once and in order; what is not yet done is the lag."""

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from continuum_manipulator.load_meter import LoadMeter, Mark
from continuum_manipulator.pace import Pace

BEGIN = 1_700_000_000_000_000_000
STEPS = st.lists(st.integers(0, 2_000_000_000), max_size=50)


@given(st.floats(1, 2000), st.floats(0.001, 1), STEPS)
def test_no_instant_is_left_out(rate, most, steps):
    pace, now, done, instants = Pace(rate, most, BEGIN), BEGIN, 0, [BEGIN - round(0.5e9 / rate)]
    for step in steps:
        now += step
        for number in pace.due(now):
            assert number == done + 1
            done = number
            instants.append(pace.reach(number))
            assert instants[-1] <= now
        if pace.lag(now) == 0:
            assert now - instants[-1] <= 1e9 / rate + 1
    gaps = [later - earlier for earlier, later in pairwise(instants)]
    assert all(abs(gap - 1e9 / rate) <= 1 for gap in gaps)


def test_a_long_time_is_given_out_in_parts_and_all_of_it():
    pace, now, parts = Pace(100.0, 0.25, BEGIN), BEGIN + 10_000_000_000, []
    while due := pace.due(now):
        parts.append(len(due))
        for number in due:
            pace.reach(number)
    assert max(parts) == 25
    assert sum(parts) == 1000
    assert pace.lag(now) == 0


def test_lag_is_how_long_the_next_instant_has_been_due():
    pace = Pace(100.0, 1.0, BEGIN)
    assert pace.lag(BEGIN) == 0
    assert abs(pace.lag(BEGIN + 500_000_000) - 0.495) < 1e-6


@given(st.floats(1, 2000), st.integers(0, 10**10), st.floats(0, 1))
def test_whoever_has_no_lag_covers_all_of_the_time(rate, step, done):
    pace, now = Pace(rate, 1e9, BEGIN), BEGIN + step
    due = pace.due(now)
    for number in due[: round(done * len(due))]:
        pace.reach(number)
    if pace.lag(now) == 0:
        assert pace.covered(now) == pace.seconds(now)
    else:
        assert abs(pace.covered(now) - pace.seconds(pace.last) - 1 / rate) < 2e-9 + 1e-6 / rate


def test_a_clock_that_goes_back_is_seen():
    pace = Pace(100.0, 1.0, BEGIN)
    pace.due(BEGIN + 50)
    assert not pace.went_back(BEGIN + 50)
    assert pace.went_back(BEGIN + 49)
    assert not pace.due(BEGIN + 49)
    assert pace.went_back(BEGIN + 49)
    pace.begin(BEGIN - 10**9)
    assert list(pace.due(BEGIN - 10**9 + 5_000_000)) == [1]


def test_the_meter_counts_the_last_seconds():
    meter = LoadMeter()
    assert (meter.real_time_factor, meter.load) == (0.0, 0.0)
    for i in range(100):  # at first twice as slow
        meter.mark(Mark(0.1 * i, 0.05 * i, 0.05 * i))
    for i in range(100):
        meter.mark(Mark(10 + 0.1 * i, 5 + 0.02 * i, 5 + 0.1 * i))
    assert abs(meter.real_time_factor - 1.0) < 1e-9
    assert abs(meter.load - 0.2) < 1e-9
