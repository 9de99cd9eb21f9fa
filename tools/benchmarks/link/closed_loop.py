"""Minutes of streaming with continuous release tests: errors of angles, frames, delays, load."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from emulated_bench import Bridge

from continuum.arrays import Array
from tools.benchmarks.link.latency import Delays, delays, load_sent
from tools.benchmarks.link.latency_probe import State
from tools.benchmarks.link.processes import core_share, usage
from tools.benchmarks.link.rig import Rig, rig
from tools.benchmarks.link.truth import Truth, errors_of, load_truth, rms_of_worst

SWING = 2.0
"""Time after a release that counts as the release test [s]."""

PULLED, HIGHEST, CALM = 2.0, 15.0, 5.0
"""Duration of a pull [s], its final tension [N], and time for which the arm then swings and rests [s]."""

MINUTE = 60.0


@dataclass(frozen=True)
class Minute:
    """One minute of a run: load of the machine (average of that minute), and delays until reception [ms]."""

    load: float
    median: float
    slowest_percent: float


@dataclass(frozen=True)
class ClosedLoop:
    """One run.

    Attributes:
        minutes: duration [min].
        releases: number of releases.
        frames: number of sensor frames that the emulator wrote, from the first to the last with a joint state.
        rate: joint states per second, by their stamps.
        lost: number of frames that the bridge counts as lost, by gaps in the sequence.
        missing: number of frames without a joint state.
        skipped: time that the emulator skipped [s].
        released, resting: RMS of the worst joint [degrees].
        released_largest: largest error of any joint in release tests [degrees].
        shift: stamp minus true instant: smallest, median, largest [ms].
        until: delay from the last written byte to each stage: median, 99 %, largest [ms].
        by_minute: values of each minute.
        bridge_share, emulator_share: fractions of one core.
    """

    minutes: float
    releases: int
    frames: int
    rate: float
    lost: int
    missing: int
    skipped: float
    released: float
    resting: float
    released_largest: float
    shift: list[float]
    until: dict[str, list[float]]
    by_minute: list[Minute]
    bridge_share: float
    emulator_share: float


def measure(minutes: float, folder: Path) -> ClosedLoop:
    """Run the closed loop."""
    releases, loads, states = [], [], []
    with rig(folder) as bench, bench.bridge(max_tension=20.0) as bridge:
        pids = bridge.node.process.pid, bench.bench.process.process.pid
        before = [usage(pid) for pid in pids]
        begin = minute_begin = time.monotonic()
        for let_go in _courses(bench, bridge):
            releases.append(let_go)
            states += bench.latency_probe.joints
            bench.latency_probe.clear()
            if time.monotonic() - minute_begin >= MINUTE:
                minute_begin += MINUTE
                loads.append(os.getloadavg()[0])
                print(f"  {len(loads)} min, load {loads[-1]:.1f}", flush=True)
            if time.monotonic() - begin >= MINUTE * minutes:
                break
        lasted = time.monotonic() - begin
        shares = [core_share(was, usage(pid)) for was, pid in zip(before, pids, strict=True)]
        bridge.probe.wait_for_report(f"{bridge.name}: link")
        lost = int(bridge.diagnostic("link")["frames lost"])
        skipped = float(bench.bench.status["skipped"])
    truth = load_truth(bench.truth_file)
    found = delays(states, *load_sent(bench.sent_file, truth))
    off = _errors(states, truth, releases)
    return ClosedLoop(
        minutes=lasted / MINUTE,
        releases=len(releases),
        frames=len(found.received) + found.missing,
        rate=(len(states) - 1) / (states[-1].stamp - states[0].stamp),
        lost=lost,
        missing=found.missing,
        skipped=skipped,
        **off,
        shift=[1e3 * float(np.quantile(found.shift, part)) for part in (0.0, 0.5, 1.0)],
        until={name: _scatter(getattr(found, name)) for name in ("published", "received", "called")},
        by_minute=by_minute(found, begin, loads),
        bridge_share=shares[0],
        emulator_share=shares[1],
    )


def _courses(bench: Rig, bridge: Bridge) -> Iterator[float]:
    """Pull one cable, the other, and the hand in turn; yield the times of the releases [s]."""
    while True:
        for cable in (0, 1):
            bench.drive(bridge, lambda t, k=cable: HIGHEST * min(t / (0.75 * PULLED), 1.0) * np.eye(2)[k], PULLED)
            let_go = time.monotonic()
            bridge.call("release")
            bench.drive(bridge, None, CALM)
            yield let_go
        bench.bench.tell("hand bend=90 over=1 hold=1")
        let_go = time.monotonic() + 2.0
        bench.drive(bridge, None, 2.0 + CALM)
        yield let_go


def _errors(states: Sequence[State], truth: Truth, releases: Sequence[float]) -> dict[str, float]:
    stamps, off = errors_of(states, truth)
    swinging = np.zeros(len(stamps), dtype=bool)
    for let_go in releases:
        swinging |= (stamps >= let_go) & (stamps <= let_go + SWING)
    resting = np.interp(stamps, truth.time, truth.resting()) == 1.0
    return {
        "released": rms_of_worst(off[swinging]),
        "resting": rms_of_worst(off[resting]),
        "released_largest": float(np.degrees(np.abs(off[swinging]).max())),
    }


def _scatter(delay: Array) -> list[float]:
    """Median, 99 %, largest [ms]."""
    return [1e3 * float(np.quantile(delay, part)) for part in (0.5, 0.99, 1.0)]


def by_minute(found: Delays, begin: float, loads: Sequence[float]) -> list[Minute]:
    """Return the delays until reception of every complete minute since ``begin`` [s], with ``loads`` at their ends."""
    minutes = []
    for k, load in enumerate(loads):
        inside = (found.written >= begin + k * MINUTE) & (found.written < begin + (k + 1) * MINUTE)
        if inside.any():
            median, slow, _ = _scatter(found.received[inside])
            minutes.append(Minute(load, median, slow))
    return minutes
