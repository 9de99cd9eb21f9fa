"""What issue and protocol want, beside what was measured."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from continuum_hw_imu.protocol.messages.forces import STEP
from tools.bench_link.campaign import FASTEST, MOST, RIGHT, Case
from tools.bench_link.closed_loop import ClosedLoop
from tools.bench_link.crash_tests import LIMITS, TICK, Crash
from tools.bench_link.results import Results
from tools.bench_link.rig import RATE
from tools.bench_link.soak import Soak

RISE_ROUNDING = 2 * STEP * RATE
"""Of a rate taken from two set points, each rounded [N/s]."""

SLACK = LIMITS.slack_time

FLAT = 1.0
"""Growth of memory that counts as flat, in an hour [MiB]."""


@dataclass(frozen=True)
class Goal:
    """One line of the table."""

    what: str
    wanted: str
    figure: str
    met: bool


def goals(results: Results) -> list[Goal]:
    """Those of which there are figures."""
    lines: list[Goal] = []
    parts: Sequence[tuple[object, Callable[..., Iterator[Goal]]]] = (
        (results.closed and results.closed[-1], _closed),
        (results.campaign, _campaign),
        (results.crash_tests, _crashes),
        (results.soak, _soak),
    )
    for result, output in parts:
        if result:
            lines += output(result)
    return lines


def _closed(run: ClosedLoop) -> Iterator[Goal]:
    slow = run.until["received"][1]
    yield Goal("release tests, RMS of the worst joint", "<= 0.5 degrees", f"{run.released:.2f}", run.released <= 0.5)
    yield Goal("at rest, RMS of the worst joint", "<= 0.3 degrees", f"{run.resting:.2f}", run.resting <= 0.3)
    yield Goal("five sensors streaming", ">= 10 minutes", f"{run.minutes:.1f}", run.minutes >= 10.0)
    yield Goal("joint states a second", "60 Hz", f"{run.rate:.2f}", abs(run.rate - RATE) < 0.01 * RATE)
    lost = run.lost + run.missing
    yield Goal("frames lost by the bridge, or without joint state", "0", f"{lost} of {run.frames}", lost == 0)
    yield Goal("frame to /joint_states, 99 %", "<= 10 ms", f"{slow:.1f}", slow <= 10.0)


def _campaign(cases: Sequence[Case]) -> Iterator[Goal]:
    resumed = [case.resumed for case in cases]
    known = [time for time in resumed if time is not None]
    never = len(resumed) - len(known)
    figure = f"{max(known, default=0.0):.2f}" + (f", never in {never} cases" if never else "")
    yield Goal("data stream again after any fault", "<= 1 s", figure, not never and max(known) <= 1.0)
    wrong, states = sum(case.wrong for case in cases), sum(case.states for case in cases)
    far = max(case.largest_error for case in cases)
    yield Goal(
        f"joint states with an angle more than {RIGHT:g} degrees off",
        "0",
        f"{wrong} of {states}; largest {far:.2f} degrees",
        wrong == 0,
    )
    tension, rise = max(case.largest_tension for case in cases), max(case.fastest_rise for case in cases)
    yield Goal("tension at the receiver", f"<= {MOST:g} N", f"{tension:.2f}", tension <= MOST + STEP)
    yield Goal("its rise", f"<= {FASTEST:g} N/s", f"{rise:.1f}", rise <= FASTEST + RISE_ROUNDING)


def _crashes(crash_tests: Sequence[Crash]) -> Iterator[Goal]:
    for crash in crash_tests:
        worst = max(crash.times)
        yield Goal(f"slack after: {crash.name}", _slack(crash.stated, 1), f"{worst:.2f}", worst <= crash.stated + TICK)
    ramp = max(time - begun for crash in crash_tests for time, begun in zip(crash.times, crash.begun, strict=True))
    yield Goal("slack after the receiver began to let go", _slack(SLACK, 2), f"{ramp:.2f}", ramp <= SLACK + 2 * TICK)


def _slack(stated: float, readings: int) -> str:
    """Of so many instants, each is known to one look at the receiver."""
    return f"<= {stated:g} s + {1e3 * readings * TICK:.0f} ms"


def _soak(run: Soak) -> Iterator[Goal]:
    yield Goal("streaming, as hours at 60 Hz", ">= 1", f"{run.hours:.2f}", run.hours >= 1.0)
    for name, memory in (("bridge", run.bridge), ("emulator", run.emulator)):
        figure = f"{memory.growth:+.2f}"
        yield Goal(f"memory of the {name}, growth in such an hour", f"<= {FLAT:g} MiB", figure, memory.growth <= FLAT)
