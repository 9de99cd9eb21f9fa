"""Goals of the bridge, with the measured values."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from continuum_hw_imu.protocol.messages.forces import STEP
from tools.benchmarks.link.campaign import FASTEST, MOST, Case
from tools.benchmarks.link.closed_loop import ClosedLoop
from tools.benchmarks.link.crash_tests import LIMITS, TICK, Crash
from tools.benchmarks.link.results import Results
from tools.benchmarks.link.rig import RATE
from tools.benchmarks.link.soak import Soak
from tools.benchmarks.link.starvation import Starved
from tools.benchmarks.record import Figure

RISE_ROUNDING = 2 * STEP * RATE
"""Rounding error of a rate between two rounded set points [N/s]."""

SLACK = LIMITS.slack_time

FLAT = 1.0
"""Growth of memory that counts as flat, in an hour [MiB]."""


def goals(results: Results) -> tuple[Figure, ...]:
    """Return the goals with available figures, safety first."""
    figures: list[Figure] = []
    parts: Sequence[tuple[object, Callable[..., Iterator[Figure]]]] = (
        (results.crash_tests, _crashes),
        (results.campaign, _campaign),
        (results.starvation, _starvation),
        (results.closed and results.closed[-1], _closed),
        (results.soak, _soak),
    )
    for result, output in parts:
        if result:
            figures += output(result)
    return tuple(figures)


def _closed(run: ClosedLoop) -> Iterator[Figure]:
    slow, lost = run.until["received"][1], run.lost + run.missing
    yield Figure("bridge, release tests: RMS of the worst joint", run.released, "degrees", at_most=0.5)
    yield Figure("bridge, frame to /joint_states: 99 %", slow, "ms", at_most=10.0)
    yield Figure("bridge: frames lost, or without joint state", lost, at_most=0, n=run.frames)
    yield Figure("bridge, at rest: RMS of the worst joint", run.resting, "degrees", at_most=0.3)
    yield Figure("bridge: joint states a second", run.rate, "Hz", at_least=0.99 * RATE, at_most=1.01 * RATE)
    yield Figure("bridge: five sensors streaming", run.minutes, "minutes", at_least=10.0)


def _campaign(cases: Sequence[Case]) -> Iterator[Figure]:
    resumed = [case.resumed for case in cases]
    known, n = [time for time in resumed if time is not None], len(cases)
    wrong, states = sum(case.wrong for case in cases), sum(case.states for case in cases)
    tension, rise = max(case.largest_tension for case in cases), max(case.fastest_rise for case in cases)
    yield Figure("bridge, any fault: tension at the receiver", tension, "N", at_most=MOST + STEP, n=n)
    yield Figure("bridge, any fault: joint states with a wrong angle", wrong, at_most=0, n=states)
    yield Figure("bridge, any fault: its data stream stays away", len(resumed) - len(known), at_most=0, n=n)
    if known:
        yield Figure("bridge, any fault: data stream again after", max(known), "s", at_most=1.0, n=len(known))
    yield Figure("bridge, any fault: rise of tension", rise, "N/s", at_most=FASTEST + RISE_ROUNDING, n=n)
    yield Figure("bridge, any fault: largest error of an angle", max(c.largest_error for c in cases), "degrees", n=n)


def _starvation(ways: Sequence[Starved]) -> Iterator[Figure]:
    wrong, states = sum(way.wrong for way in ways), sum(way.states for way in ways)
    yield Figure("bridge without processor: joint states with a wrong angle", wrong, at_most=0, n=states)


def _crashes(crash_tests: Sequence[Crash]) -> Iterator[Figure]:
    for crash in crash_tests:
        what = f"cables slack after the bridge or its port goes: {crash.name}"
        yield Figure(what, max(crash.times), "s", at_most=crash.stated + TICK, n=len(crash.times))
    ramp = max(time - begun for crash in crash_tests for time, begun in zip(crash.times, crash.begun, strict=True))
    yield Figure("cables slack after the receiver began to let go", ramp, "s", at_most=SLACK + 2 * TICK)


def _soak(run: Soak) -> Iterator[Figure]:
    for name, memory in (("bridge", run.bridge), ("emulator", run.emulator)):
        yield Figure(f"memory of the {name}: growth in an hour at 60 Hz", memory.growth, "MiB", at_most=FLAT)
    yield Figure("bridge: streaming as much as in hours at 60 Hz", run.hours, "hours", at_least=1.0)
