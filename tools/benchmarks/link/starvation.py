"""Wrong angles of a bridge that is starved of the processor on purpose, from its start on, also on a bad line."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from emulated_bench import bridge_at, stopped_again_and_again

from tools.benchmarks.link.campaign import RIGHT, to_and_fro
from tools.benchmarks.link.latency_probe import State
from tools.benchmarks.link.rig import RATE, Rig, rig
from tools.benchmarks.link.truth import Truth, errors_of, load_truth

BUSY = 2
"""Number of busy processes beside the bridge on its core."""

PIECE = 1.0
"""Time after which a bridge that has become inactive is activated again [s]."""


@dataclass(frozen=True)
class Way:
    """One way to starve a bridge.

    Attributes:
        name: description.
        stopped: longest time for which the process is stopped again and again [s]; 0 for never.
        runs: longest time for which it runs in between [s].
        niceness: by how much the bridge gives way to busy processes on the same core; None without them.
        order: fault of the line.
    """

    name: str
    stopped: float = 0.0
    runs: float = 0.01
    niceness: int | None = None
    order: str = ""


WAYS = (
    Way("undisturbed"),
    Way("stopped for up to 0.03 s", stopped=0.03),
    Way("stopped for up to 0.2 s", stopped=0.2, runs=0.1),
    Way("stopped for up to 1 s", stopped=1.0, runs=1.0),
    Way("beside two busy processes", niceness=0),
    Way("beside two busy processes, nice 5", niceness=5),
    Way("stopped for up to 0.03 s, late frames", stopped=0.03, order="late share=0.5 by=0.2"),
    Way("stopped for up to 0.03 s, damaged frames", stopped=0.03, order="damage share=0.1"),
    Way("beside two busy processes, late frames", niceness=0, order="late share=0.5 by=0.2"),
    Way("beside two busy processes, damaged frames", niceness=0, order="damage share=0.1"),
)


@dataclass(frozen=True)
class Starved:
    """Result of one way.

    Attributes:
        name: its description.
        load: average load of the machine in the last minute.
        published: fraction of the samples, from the first activation on, whose joint states were published.
        states: number of joint states.
        wrong: number of joint states with an angle that is more than `RIGHT` off the truth at its stamp.
        largest_error: largest error of an angle [degrees].
    """

    name: str
    load: float
    published: float
    states: int
    wrong: int
    largest_error: float


@dataclass(frozen=True)
class _Course:
    name: str
    load: float
    lasted: float
    joints: list[State]


def measure(folder: Path, seconds: float) -> list[Starved]:
    """Run every way for a time [s], each with a new bridge at the same emulated bench."""
    courses = []
    with rig(folder) as bench, _elsewhere(bench):
        for number, way in enumerate(WAYS):
            courses.append(_course(bench, way, seconds, number))
    truth = load_truth(bench.truth_file)
    found = [evaluated(course, truth) for course in courses]
    for one in found:
        print(f"  {one.name}: joint states with a wrong angle: {one.wrong} of {one.states}", flush=True)
    return found


def _course(bench: Rig, way: Way, seconds: float, seed: int) -> _Course:
    bench.wait_for_free_port()
    given = {"calibration": bench.calibration, "keep_bias": True}
    with (
        bridge_at(bench.latency_probe, bench.bench, bench.domain, **given) as bridge,
        _starved(bridge.node.process.pid, way, seed),
    ):
        bridge.wait_for_state("inactive")
        if way.order:
            bench.bench.tell(f"{way.order} for={seconds} way=both")
        for _ in range(round(seconds / PIECE)):
            if bridge.state != "active":
                bridge.change("activate")
            bench.drive(bridge, to_and_fro, PIECE)
        joints = list(bench.latency_probe.joints)
        bench.bench.tell("clear")
        print(f"  {way.name}", flush=True)
    return _Course(way.name, os.getloadavg()[0], seconds, joints)


def evaluated(course: _Course, truth: Truth) -> Starved:
    """Evaluate a course against the truth."""
    _, off = errors_of(course.joints, truth)
    far = np.degrees(np.abs(off).max(axis=1, initial=0.0))
    return Starved(
        name=course.name,
        load=course.load,
        published=len(far) / (RATE * course.lasted),
        states=len(far),
        wrong=int(np.count_nonzero(far > RIGHT)),
        largest_error=float(far.max(initial=0.0)),
    )


@contextmanager
def _starved(process: int, way: Way, seed: int) -> Iterator[None]:
    """Starve a process during the block."""
    core = {min(os.sched_getaffinity(0))}
    busy: list[subprocess.Popen[bytes]] = []
    with ExitStack() as stack:
        _confine([process], core, os.getpriority(os.PRIO_PROCESS, 0) + (way.niceness or 0))
        if way.niceness is not None:
            busy += [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(BUSY)]
            for one in busy:
                stack.callback(one.wait)
                stack.callback(one.kill)
            _confine([one.pid for one in busy], core)
        if way.stopped:
            stack.enter_context(stopped_again_and_again(process, way.stopped, way.runs, seed))
        yield


@contextmanager
def _elsewhere(bench: Rig) -> Iterator[None]:
    """Keep the emulator and this process off the first core if there is another one."""
    cores = os.sched_getaffinity(0)
    _confine([0, bench.bench.process.process.pid], cores - {min(cores)} or cores)
    try:
        yield
    finally:
        _confine([0], cores)


def _confine(processes: Sequence[int], cores: set[int], niceness: int | None = None) -> None:
    """Restrict processes and their threads to cores."""
    for process in processes:
        tasks = Path(f"/proc/{process or os.getpid()}/task").iterdir()
        for task in tasks:
            os.sched_setaffinity(int(task.name), cores)
            if niceness is not None:
                os.setpriority(os.PRIO_PROCESS, int(task.name), niceness)
