"""The record of the bridge at the emulated bench: its goals, and tables of every part."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence

from tools.benchmarks.link.campaign import Case
from tools.benchmarks.link.closed_loop import ClosedLoop
from tools.benchmarks.link.crash_tests import Crash
from tools.benchmarks.link.goals import goals
from tools.benchmarks.link.results import Results
from tools.benchmarks.link.soak import Soak
from tools.benchmarks.link.starvation import Starved
from tools.benchmarks.record import Record, Table

_STAGES = {
    "published": "given to DDS by the bridge",
    "received": "received by DDS in the subscriber's process",
    "called": "given to the subscriber, which is in Python",
}


def record_of(results: Results) -> Record:
    """Return the record of all available results."""
    niceness = ", ".join(f"{part} {number}" for part, number in results.niceness.items())
    tables, notes = dict[str, Table](), [f"{os.cpu_count()} cores; niceness: {niceness or 'unknown'}."]
    if results.closed:
        tables |= _closed(results.closed)
        notes.append(_of_closed(results.closed[-1]))
    if results.campaign:
        tables["faults"] = _campaign(results.campaign)
        wrong = sum(case.wrong for case in results.campaign) / max(1, sum(case.states for case in results.campaign))
        notes.append(f"Fault campaign: {wrong:.2%} of the joint states had a wrong angle.")
    if results.crash_tests:
        tables["crash tests"] = _crashes(results.crash_tests)
    if results.starvation:
        tables["starvation"] = _by_columns(_WAYS, results.starvation)
    if results.soak:
        tables["memory"] = _soak(results.soak)
        notes.append(_of_soak(results.soak))
    return Record("link", "make bench-link", goals(results), tables, tuple(notes))


def _of_closed(run: ClosedLoop) -> str:
    return (
        f"Closed loop: {run.releases} release tests, in which the largest error of any joint is"
        f" {run.released_largest:.2f} degrees; stamps are {run.shift[1]:.2f} ms after the true instant (median;"
        f" {run.shift[0]:.2f} to {run.shift[2]:.2f} ms); load {_loads(run)}; the bridge takes {run.bridge_share:.1%} of"
        f" one core, the emulator {run.emulator_share:.1%}, which stood still for {run.skipped:.1f} s."
    )


def _of_soak(run: Soak) -> str:
    return (
        f"Memory: {run.minutes:.0f} minutes at {run.rate:g} Hz, of which {run.reached:.1f} joint states a second came:"
        f" as many as in {run.hours:.2f} hours at 60 Hz; load {run.load:.1f}; {run.lost} frames lost."
    )


def _closed(runs: Sequence[ClosedLoop]) -> Mapping[str, Table]:
    """Return tables of the delays of the newest run, its minutes, and all runs, the newest last."""
    run = runs[-1]
    return {
        "delays": Table.of(
            ("delay until joint states are [ms]", "median", "99 %", "largest"),
            [(_STAGES[name], *(f"{value:.2f}" for value in run.until[name])) for name in _STAGES],
        ),
        "minutes": Table.of(
            ("minute", "load", "delay until received, median [ms]", "99 % [ms]"),
            [
                (k, f"{minute.load:.1f}", f"{minute.median:.2f}", f"{minute.slowest_percent:.2f}")
                for k, minute in enumerate(run.by_minute, start=1)
            ],
        ),
        "runs": _by_columns(_RUNS, runs),
    }


def _loads(run: ClosedLoop) -> str:
    """Return the smallest and the largest load of the complete minutes."""
    loads = [minute.load for minute in run.by_minute]
    return f"{min(loads):.1f} to {max(loads):.1f}" if loads else "unknown"


_RUNS: Mapping[str, Callable[[ClosedLoop], object]] = {
    "minutes": lambda run: f"{run.minutes:.1f}",
    "load": _loads,
    "frames": lambda run: run.frames,
    "lost": lambda run: run.lost,
    "without joint state": lambda run: run.missing,
    "delay until received, 99 % [ms]": lambda run: f"{run.until['received'][1]:.1f}",
    "released [degrees]": lambda run: f"{run.released:.2f}",
    "at rest [degrees]": lambda run: f"{run.resting:.2f}",
}


def _campaign(cases: Sequence[Case]) -> Table:
    return _by_columns(_CASES, cases)


def _seconds(time: float | None) -> str:
    return "never" if time is None else f"{time:.2f}"


_CASES: Mapping[str, Callable[[Case], object]] = {
    "faults": lambda case: " and ".join(case.faults),
    "data again [s]": lambda case: _seconds(case.resumed),
    "angles again [s]": lambda case: _seconds(case.angles_back),
    "joint states": lambda case: case.states,
    "largest error [degrees]": lambda case: f"{case.largest_error:.2f}",
    "wrong": lambda case: case.wrong,
    "largest tension [N]": lambda case: f"{case.largest_tension:.2f}",
    "inactive, since": lambda case: case.fell_back,
    "emulator late [ms]": lambda case: f"{1e3 * case.stalled:.0f}",
    "load": lambda case: f"{case.load:.1f}",
}


_WAYS: Mapping[str, Callable[[Starved], object]] = {
    "bridge": lambda way: way.name,
    "samples with joint states": lambda way: f"{way.published:.0%}",
    "joint states": lambda way: way.states,
    "wrong": lambda way: way.wrong,
    "largest error [degrees]": lambda way: f"{way.largest_error:.2f}",
    "load": lambda way: f"{way.load:.1f}",
}


def _crashes(crash_tests: Sequence[Crash]) -> Table:
    return Table.of(
        ("what happens", "slack, stated [s]", "slack [s]", "let go [s]", "load"),
        [
            (crash.name, f"{crash.stated:g}", _sorted(crash.times), _sorted(crash.begun), f"{max(crash.loads):.1f}")
            for crash in crash_tests
        ],
    )


def _sorted(times: Sequence[float]) -> str:
    return ", ".join(f"{time:.2f}" for time in sorted(times))


def _soak(run: Soak) -> Table:
    return Table.of(
        ("", "settled [MiB]", "at the end [MiB]", "growth in an hour at 60 Hz [MiB]", "of one core"),
        [
            (name, f"{m.settled:.1f}", f"{m.last:.1f}", f"{m.growth:+.2f}", f"{m.core:.0%}")
            for name, m in (("bridge", run.bridge), ("emulator", run.emulator))
        ],
    )


def _by_columns[T](columns: Mapping[str, Callable[[T], object]], items: Sequence[T]) -> Table:
    return Table.of([*columns], [[cell(item) for cell in columns.values()] for item in items])
