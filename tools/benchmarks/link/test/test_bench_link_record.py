"""Goals met and missed, results kept and read again, and the record of them."""

from dataclasses import replace

import numpy as np
import pytest

from tools.benchmarks.link.campaign import Case, _Course, evaluated
from tools.benchmarks.link.closed_loop import ClosedLoop, Minute, by_minute
from tools.benchmarks.link.command import main
from tools.benchmarks.link.crash_tests import Crash
from tools.benchmarks.link.goals import goals
from tools.benchmarks.link.latency import Delays
from tools.benchmarks.link.latency_probe import Sample, State
from tools.benchmarks.link.processes import Usage
from tools.benchmarks.link.results import PARTS, Results, keep, load, together
from tools.benchmarks.link.soak import Memory, Soak, memory_of
from tools.benchmarks.link.starvation import Starved
from tools.benchmarks.link.tables import record_of
from tools.benchmarks.link.truth import Truth

CLOSED = ClosedLoop(
    10.0, 80, 36_000, 60.0, 0, 0, 0.0, 0.1, 0.05, 0.4, [0.1, 0.2, 0.9],
    {"published": [0.8, 4.0, 8.0], "received": [0.9, 5.0, 9.0], "called": [1.2, 6.0, 11.0]},
    [Minute(3.0, 0.9, 5.0)], 0.1, 0.1,
)  # fmt: skip
CASE = Case(["lost", "late"], 3.0, 0.01, 0.3, 0.1, 400, 0.7, 0, 12.0, 120.0, "the port is not there")
CRASH = Crash("killed (SIGKILL)", 0.0, [0.5, 0.48], [0.01, 0.0], [3.0, 3.0])
WAY = Starved("stopped", 1.0, 0.7, 1200, 0, 0.6)
SOAK = Soak(20.0, 180.0, 180.0, 3.0, 0, Memory(80.0, 80.1, 0.1, 0.3), Memory(90.0, 90.0, 0.0, 0.3))
ALL = Results([CLOSED], [CASE], [CRASH], [WAY], SOAK, dict.fromkeys(PARTS, 3))

SPOILED = {
    "bridge, release tests": replace(ALL, closed=[replace(CLOSED, released=0.51)]),
    "bridge, at rest": replace(ALL, closed=[replace(CLOSED, resting=0.31)]),
    "bridge: five sensors": replace(ALL, closed=[replace(CLOSED, minutes=9.0)]),
    "bridge: joint states a second": replace(ALL, closed=[replace(CLOSED, rate=59.0)]),
    "bridge: frames lost": replace(ALL, closed=[replace(CLOSED, missing=1)]),
    "bridge, frame to": replace(ALL, closed=[replace(CLOSED, until={**CLOSED.until, "received": [1.0, 10.1, 20.0]})]),
    "bridge, any fault: its data stream": replace(ALL, campaign=[CASE, replace(CASE, resumed=None)]),
    "bridge, any fault: data stream again": replace(ALL, campaign=[CASE, replace(CASE, resumed=1.1)]),
    "bridge, any fault: joint states with": replace(ALL, campaign=[CASE, replace(CASE, wrong=1)]),
    "bridge, any fault: tension": replace(ALL, campaign=[CASE, replace(CASE, largest_tension=12.1)]),
    "bridge, any fault: rise": replace(ALL, campaign=[CASE, replace(CASE, fastest_rise=130.0)]),
    "bridge without processor": replace(ALL, starvation=[WAY, replace(WAY, wrong=1)]),
    "cables slack after the bridge": replace(ALL, crash_tests=[replace(CRASH, times=[0.4, 0.6], begun=[0.0, 0.2])]),
    "cables slack after the receiver": replace(ALL, crash_tests=[replace(CRASH, begins=0.25, times=[0.4, 0.6])]),
    "bridge: streaming": replace(ALL, soak=replace(SOAK, minutes=10.0)),
    "memory of the bridge": replace(ALL, soak=replace(SOAK, bridge=Memory(80.0, 90.0, 1.1, 0.3))),
}


def test_all_goals_can_be_met():
    assert all(figure.is_met is not False for figure in goals(ALL))


@pytest.mark.parametrize("beginning", SPOILED)
def test_each_goal_can_be_missed_alone(beginning):
    missed = [figure.what for figure in goals(SPOILED[beginning]) if figure.is_met is False]
    assert len(missed) == 1
    assert missed[0].startswith(beginning)


def test_results_are_read_as_they_were_kept(tmp_path):
    assert load(tmp_path) == Results(None, None, None, None, None)
    for part in PARTS:
        keep(tmp_path, part, getattr(ALL, part), ALL.niceness[part])
    assert load(tmp_path) == ALL


def test_cases_of_a_later_run_count():
    again, other = replace(CASE, resumed=0.2), replace(CASE, faults=["noise"])
    assert together(None, [CASE]) == [CASE]
    assert together([CASE, other], [again]) == [again, other]


@pytest.mark.parametrize("part", PARTS)
def test_the_record_leaves_out_what_was_not_run(part):
    whole, less = record_of(ALL), record_of(replace(ALL, **{part: None}))
    assert {*less.figures} < {*whole.figures}
    assert {*less.tables} < {*whole.tables}
    assert all(len(row) == len(one.head) for one in whole.tables.values() for row in one.rows)


def test_a_run_of_less_than_a_minute_has_a_record():
    assert record_of(replace(ALL, closed=[replace(CLOSED, by_minute=[])])).tables["minutes"].rows == ()


@pytest.mark.parametrize("words", ["campaign --faults typo", "--faults lost campaign", "typo"])
def test_faults_and_parts_that_there_are_not_are_refused(words, capsys):
    with pytest.raises(SystemExit):
        main(words.split())
    assert capsys.readouterr().err.splitlines()[-1].startswith("make bench-link ARGS=...: error: ")


def test_a_case_is_judged_by_the_truth():
    time = 100.0 + np.arange(600) / 60
    angles = np.zeros((600, 2))
    rates = np.where((time < 104.0)[:, None], 1.0, np.zeros((600, 2)))
    tension = np.where((time < 103.0)[:, None], 9.0, np.zeros((600, 2)))
    known = Truth(1e6 * time, time, angles, rates, tension, tension, tension[:, 0] > 0)
    off = [np.radians([0.0, 2.0 if 101 < t < 101.1 else 0.1]) for t in time]
    joints = [State(t, t, t + 0.02, t, angle) for t, angle in zip(time, off, strict=True) if not 102 < t < 104.5]
    imus = [[Sample(t, t + 0.01) for t in time if not 101.5 < t < back] for back in (102.2, 102.4)]
    case = evaluated(_Course(("lost",), 100.5, 102.0, 109.0, 3.0, joints, imus, ""), known, (time + 0.003, time))
    assert case.stalled == pytest.approx(0.003)
    assert case.resumed == pytest.approx(0.41, abs=1 / 60)
    assert case.angles_back == pytest.approx(0.02, abs=1 / 60)  # at rest from 105 on
    assert (case.wrong, case.largest_error, case.largest_tension) == (5, pytest.approx(2.0), 9.0)


def test_minutes_are_reckoned_apart():
    written = np.arange(0.0, 120.0, 0.5)
    delay = np.where(written < 60.0, 0.001, 0.002)
    found = Delays(written, delay, delay, delay, 0, delay)
    assert [minute.median for minute in by_minute(found, 0.0, [1.0, 2.0])] == pytest.approx([1.0, 2.0])


def test_growth_of_memory_is_that_in_an_hour_at_live_speed():
    seen = [Usage(5.0 * k, 2.0 * k, 1024 * (100 if k < 20 else 80) + 8 * k) for k in range(100)]
    memory = memory_of(seen, 3.0)
    assert memory.growth == pytest.approx(8 / 5 * 3600 / 1024 / 3)
    assert memory.core == pytest.approx(0.4)
