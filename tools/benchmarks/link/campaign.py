"""Every fault alone and in pairs, while commands beyond the receiver's limits pull the arm back and forth."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from emulated_bench import Bridge

from continuum.arrays import Array
from tools.benchmarks.link.faults import LASTS, NO_DRIFT, orders
from tools.benchmarks.link.latency import load_sent
from tools.benchmarks.link.latency_probe import Sample, State
from tools.benchmarks.link.resumption import good_again
from tools.benchmarks.link.rig import RATE, Rig, rig
from tools.benchmarks.link.truth import Truth, errors_of, load_truth

MOST, FASTEST = 12.0, 120.0
"""Limits of the receiver [N], [N/s]; the bridge allows more, and more is commanded."""

COMMANDED, HALF = 16.0, 0.4
"""Tension of the alternating pulls [N], and duration of each pull [s]."""

PULLED_ON = 1.0
"""Time for which the pulls continue after the fault [s]."""

CALM = 2.5
"""Duration of the rest after the pulls [s], within which the angles return."""

RIGHT = 1.5
"""Error above which a published joint angle counts as wrong [degrees]: three times the allowed RMS."""

_FALLEN = "fell back to inactive, cables slack:"
"""Beginning of the bridge's message, before the reason."""


@dataclass(frozen=True)
class Case:
    """Result of one case.

    Attributes:
        faults: names of the faults.
        load: average load of the machine in the last minute.
        stalled: largest delay of the emulator with a frame after the fault because the machine was busy [s].
        resumed: time from the end of the fault until all sensors' data are complete again [s]; None if they are not.
        angles_back: the same for joint states, from the end of the fault or of the arm's motion, whichever is later.
        states: number of joint states published during the fault and after it.
        largest_error: largest error of their angles [degrees].
        wrong: number of joint states with an error above `RIGHT`.
        largest_tension: largest set point at the receiver [N].
        fastest_rise: largest rate of a set point [N/s].
        fell_back: reason for which the bridge became inactive, from its message; empty if it did not.
    """

    faults: list[str]
    load: float
    stalled: float
    resumed: float | None
    angles_back: float | None
    states: int
    largest_error: float
    wrong: int
    largest_tension: float
    fastest_rise: float
    fell_back: str


@dataclass(frozen=True)
class _Course:
    """Messages of a case, and the times of its start, the end of the fault and its end, by the monotonic clock [s]."""

    case: tuple[str, ...]
    begin: float
    back: float
    end: float
    load: float
    joints: list[State]
    imus: list[list[Sample]]
    fell_back: str


def measure(folder: Path, cases: Sequence[tuple[str, ...]]) -> list[Case]:
    """Run cases on one emulated bench, with one bridge."""
    limits = "--max-tension", str(MOST), "--max-rate", str(FASTEST)
    courses = []
    with rig(folder, *limits) as bench, bench.bridge(max_tension=30.0, max_tension_rate=1000.0) as bridge:
        for case in cases:
            courses.append(_course(bench, bridge, case))
            print(f"  {' and '.join(case)}; {courses[-1].fell_back}", flush=True)
    truth = load_truth(bench.truth_file)
    sent = load_sent(bench.sent_file, truth)
    return [evaluated(course, truth, sent) for course in courses]


def to_and_fro(t: float) -> Array:
    """Return the tensions of sudden alternating pulls at a time [s]."""
    return COMMANDED * np.eye(2)[int(t / HALF) % 2]


def reactivate(bridge: Bridge) -> None:
    """Activate a bridge that has become inactive as soon as it can be; until then it publishes nothing."""
    if bridge.state != "active":
        bridge.probe.wait_until(lambda: bridge.change("activate") or bridge.state == "active", "an active bridge")


def _course(bench: Rig, bridge: Bridge, case: tuple[str, ...]) -> _Course:
    reactivate(bridge)
    bench.wait_for_joints(bridge)
    bench.drive(bridge, to_and_fro, 4 * HALF)
    bench.latency_probe.clear()
    begin, before = time.monotonic(), len(bridge.node.stderr)
    for order in orders(case):
        bench.bench.tell(order)
    back = time.monotonic() + LASTS
    bench.drive(bridge, to_and_fro, back - time.monotonic())
    bench.bench.tell(NO_DRIFT)
    reactivate(bridge)
    bench.drive(bridge, to_and_fro, PULLED_ON)
    bench.drive(bridge, lambda _: np.zeros(2), 4 * HALF)
    bench.drive(bridge, None, CALM)
    end, joints, imus = (
        time.monotonic(),
        list(bench.latency_probe.joints),
        [list(imu) for imu in bench.latency_probe.imus],
    )
    said = bridge.node.stderr[before:].partition(_FALLEN)[2].partition("\n")[0]
    fell_back = said.replace(str(bench.folder), "").strip(" /")
    return _Course(case, begin, back, end, os.getloadavg()[0], joints, imus, fell_back)


def evaluated(course: _Course, truth: Truth, sent: tuple[Array, Array]) -> Case:
    """Evaluate a course against the truth and the sent frames, from `load_sent`."""
    written, measured_at = sent
    after = (measured_at > course.back) & (measured_at < course.end)
    here = truth.between(course.begin, course.end)
    _, off = errors_of(course.joints, truth)
    far = np.degrees(np.abs(off).max(axis=1, initial=0.0))
    resumed = [good_again(imu, course.back, 1 / RATE) for imu in course.imus]
    since = max(course.back, _rest_begins(here))
    return Case(
        faults=list(course.case),
        load=course.load,
        stalled=float((written - measured_at)[after].max(initial=0.0)),
        resumed=_last(resumed),
        angles_back=good_again(course.joints, since, 1 / RATE),
        states=len(far),
        largest_error=float(far.max(initial=0.0)),
        wrong=int(np.count_nonzero(far > RIGHT)),
        largest_tension=float(here.set_points.max()),
        fastest_rise=here.fastest_rise(),
        fell_back=course.fell_back,
    )


def _rest_begins(truth: Truth) -> float:
    """Return the time at which the arm comes to rest [s]."""
    moving = ~truth.resting()
    return float(truth.time[np.flatnonzero(moving)[-1]]) if moving.any() else float(truth.time[0])


def _last(times: Sequence[float | None]) -> float | None:
    known = [time for time in times if time is not None]
    return max(known) if len(known) == len(times) else None
