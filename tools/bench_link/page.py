"""docs/bench-link.md, from what was measured."""

from __future__ import annotations

import os
from collections.abc import Sequence

from tools.bench_link.campaign import CALM, COMMANDED, FASTEST, HALF, MOST, PULLED_ON, RIGHT, Case
from tools.bench_link.closed_loop import HIGHEST, SWING, ClosedLoop
from tools.bench_link.crash_tests import TENSION, TICK, Crash
from tools.bench_link.faults import FAULTS, LASTS
from tools.bench_link.goals import goals
from tools.bench_link.results import Results
from tools.bench_link.resumption import WHOLE
from tools.bench_link.soak import SETTLING, Soak
from tools.bench_link.truth import REST
from tools.markdown import paragraph, table

_STAGES = {
    "published": "given to DDS by the bridge",
    "received": "had by DDS in the subscriber's process",
    "called": "given to the subscriber, which is in Python",
}


def page(results: Results) -> str:
    """The page, of all that there is."""
    head = ("what", "goal", "measured", "")
    niceness = ", ".join(f"{part} {number}" for part, number in results.niceness.items())
    lines = [(goal.what, goal.wanted, goal.figure, "met" if goal.met else "**missed**") for goal in goals(results)]
    parts = [
        "# The bridge at an emulated bench",
        paragraph(
            "Made by `make bench-link`: `bench_emulator` and `bench_bridge` as processes, a pseudo-terminal between",
            "them, real DDS behind, and a subscriber to all topics in a third process. The emulator writes down what",
            "really happens, on the clock of the same machine. Loads are averages of the last minute, on a machine",
            f"of {os.cpu_count()} cores that others used meanwhile; niceness of all processes: {niceness}.",
        ),
        table(head, lines),
    ]
    if results.closed:
        parts += [*_closed(results.closed[-1]), *_runs(results.closed)]
    if results.campaign:
        parts += _campaign(results.campaign)
    if results.crash_tests:
        parts += _crashes(results.crash_tests)
    if results.soak:
        parts += _soak(results.soak)
    return "\n\n".join(parts) + "\n"


def _closed(run: ClosedLoop) -> list[str]:
    return [
        "## Closed loop",
        paragraph(
            f"{run.releases} release tests: each cable in turn pulled with {HIGHEST:g} N and released, and the arm",
            f"bent by hand to 90 degrees and let go. Errors are those at the stamps, as published, in the {SWING:g} s",
            f"after a release and wherever the arm has not moved for {REST:g} s. Largest of any joint in release",
            f"tests: {run.released_largest:.2f} degrees. Stamps are {run.shift[1]:.2f} ms after the true instant",
            f"(median; {run.shift[0]:.2f} to {run.shift[2]:.2f} ms).",
        ),
        paragraph(
            "Delays count from the instant at which the last byte of a frame was written to the port by the",
            f"emulator. Load {_loads(run)}. The bridge takes {run.bridge_share:.1%} of one core, the",
            f"emulator {run.emulator_share:.1%}, which stood still for {run.skipped:.1f} s.",
        ),
        table(
            ("delay until joint states are [ms]", "median", "99 %", "largest"),
            [(_STAGES[name], *(f"{value:.2f}" for value in run.until[name])) for name in _STAGES],
        ),
        table(
            ("minute", "load", "delay until received, median [ms]", "99 % [ms]"),
            [
                (k, f"{minute.load:.1f}", f"{minute.median:.2f}", f"{minute.slowest_percent:.2f}")
                for k, minute in enumerate(run.by_minute, start=1)
            ],
        ),
    ]


def _runs(runs: Sequence[ClosedLoop]) -> list[str]:
    return [
        "All runs, the newest, of which the goals are, last:",
        table(
            (
                "minutes",
                "load",
                "frames",
                "lost",
                "without joint state",
                "delay until received, 99 % [ms]",
                "released [degrees]",
                "at rest [degrees]",
            ),
            [
                (
                    f"{run.minutes:.1f}",
                    _loads(run),
                    run.frames,
                    run.lost,
                    run.missing,
                    f"{run.until['received'][1]:.1f}",
                    f"{run.released:.2f}",
                    f"{run.resting:.2f}",
                )
                for run in runs
            ],
        ),
    ]


def _loads(run: ClosedLoop) -> str:
    """The least and the most of its whole minutes."""
    loads = [minute.load for minute in run.by_minute]
    return f"{min(loads):.1f} to {max(loads):.1f}" if loads else "unknown"


def _campaign(cases: Sequence[Case]) -> list[str]:
    wrong_share = sum(case.wrong for case in cases) / max(1, sum(case.states for case in cases))
    return [
        "## Fault campaign",
        paragraph(
            f"Each fault lasts {LASTS:g} s, while the cables are pulled in turn, {HALF:g} s each, with {COMMANDED:g}",
            f"N; the receiver allows {MOST:g} N and {FASTEST:g} N/s, the bridge more. It is pulled on for",
            f"{PULLED_ON:g} s after, then the arm rests for {CALM:g} s. *Data again*: from the end of the fault (the",
            f"port's return) until the first sample came since which no sensor missed one for {WHOLE:g} s. *Angles",
            "again*: likewise the joint states, from the end of the fault or, where later, from when the arm has",
            f"been at rest for {REST:g} s, since a link that was lost is found again by its inclination at rest.",
            "After a silent line the bridge is inactive, and was activated again.",
        ),
        paragraph(
            f"A joint angle is wrong if it is more than {RIGHT:g} degrees off the truth at its stamp: three times the",
            f"RMS error that is allowed in motion. {wrong_share:.2%} of the joint states had one.",
        ),
        table(("fault", "told to the emulator"), [(name, f"`{order}`") for name, order in FAULTS.items()]),
        table(
            (
                "faults",
                "data again [s]",
                "angles again [s]",
                "joint states",
                "largest error [degrees]",
                "wrong",
                "largest tension [N]",
                "inactive, since",
                "emulator late [ms]",
                "load",
            ),
            [
                (
                    " and ".join(case.faults),
                    _seconds(case.resumed),
                    _seconds(case.angles_back),
                    case.states,
                    f"{case.largest_error:.2f}",
                    case.wrong,
                    f"{case.largest_tension:.2f}",
                    case.fell_back,
                    f"{1e3 * case.stalled:.0f}",
                    f"{case.load:.1f}",
                )
                for case in cases
            ],
        ),
    ]


def _crashes(crash_tests: Sequence[Crash]) -> list[str]:
    return [
        "## When the bridge or the port goes",
        paragraph(
            f"With {TENSION:g} N on a cable and commands coming on. Times count from the signal or the order; *let",
            "go* until the receiver begins to, *slack* until all its set points are zero for good. Looked at every",
            f"{1e3 * TICK:.0f} ms, which is granted to the goals. Stated are those of docs/bench-protocol.md, which",
            "count from the instant at which the port is seen to close, or from the last heartbeat heard.",
        ),
        table(
            ("what happens", "slack, stated [s]", "slack [s]", "let go [s]", "load"),
            [
                (crash.name, f"{crash.stated:g}", _sorted(crash.times), _sorted(crash.begun), f"{max(crash.loads):.1f}")
                for crash in crash_tests
            ],
        ),
    ]


def _sorted(times: Sequence[float]) -> str:
    return ", ".join(f"{time:.2f}" for time in sorted(times))


def _soak(run: Soak) -> list[str]:
    return [
        "## Memory",
        paragraph(
            f"{run.minutes:.0f} minutes at {run.rate:g} Hz, of which {run.reached:.1f} joint states a second came: as",
            f"many as in {run.hours:.2f} hours at 60 Hz. Load {run.load:.1f}; {run.lost} frames lost. Resident",
            f"memory; growth is the slope of a straight line through all looks after the first {SETTLING:.0%} of the",
            "run.",
        ),
        table(
            ("", "settled [MiB]", "at the end [MiB]", "growth in an hour at 60 Hz [MiB]", "of one core"),
            [
                (name, f"{m.settled:.1f}", f"{m.last:.1f}", f"{m.growth:+.2f}", f"{m.core:.0%}")
                for name, m in (("bridge", run.bridge), ("emulator", run.emulator))
            ],
        ),
    ]


def _seconds(time: float | None) -> str:
    return "never" if time is None else f"{time:.2f}"
