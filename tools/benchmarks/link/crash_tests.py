"""Time until cables are slack after the bridge is killed or hangs, or the port disappears, while a cable is tight."""

from __future__ import annotations

import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum_hw_imu.protocol.messages import ReceiverLimits
from tools.benchmarks.link.rig import RATE, Rig, rig
from tools.benchmarks.link.truth import Truth, load_truth

TENSION = 10.0
"""Tension at that instant [N]."""

WATCHED = 2.0
"""Time of observation after it [s]."""

LIMITS = ReceiverLimits()

TICK = 1 / RATE
"""Time between two rows of the truth [s]."""


@dataclass(frozen=True)
class Crash:
    """Results of one kind of crash.

    Attributes:
        name: description.
        begins: latest start of the release according to docs/bench-protocol.md [s].
        times: time until all set points remain zero, for each repetition [s].
        begun: time until the start of the release, for each repetition [s].
        loads: average load of the machine in the last minute, for each repetition.
    """

    name: str
    begins: float
    times: list[float]
    begun: list[float]
    loads: list[float]

    @property
    def stated(self) -> float:
        """Specified time until the cables are slack [s]."""
        return self.begins + LIMITS.slack_time


@dataclass(frozen=True)
class Kind:
    """One kind of crash.

    Attributes:
        name: description.
        begins: latest start of the release [s]: when the closed port is detected, or heartbeats stop.
        number: signal to the bridge; None if the port is unplugged.
        is_seen: whether the emulator detects that the port is closed.
    """

    name: str
    begins: float
    number: signal.Signals | None
    is_seen: bool = True


KINDS = (
    Kind("killed (SIGKILL)", 0.0, signal.SIGKILL),
    Kind("hangs (SIGSTOP)", LIMITS.heartbeat_timeout, signal.SIGSTOP),
    Kind("port unplugged", 0.0, None),
    Kind("killed, and the closed port is not seen", LIMITS.heartbeat_timeout, signal.SIGKILL, is_seen=False),
)


def measure(folder: Path, repetitions: int) -> list[Crash]:
    """Repeat each kind of crash, each time with a new bridge."""
    return [crash for is_seen in (True, False) for crash in _measure_all(folder, is_seen, repetitions)]


def _measure_all(folder: Path, is_seen: bool, repetitions: int) -> list[Crash]:
    """Measure the kinds of crash of one emulator."""
    instants: list[tuple[Kind, list[tuple[float, float]]]] = []
    with rig(folder, *([] if is_seen else ["--no-hang-up"])) as bench:
        for kind in KINDS:
            if kind.is_seen is is_seen:
                instants.append((kind, [_instant(bench, kind) for _ in range(repetitions)]))
                print(f"  {kind.name}", flush=True)
    truth = load_truth(bench.truth_file)
    return [evaluated(kind, found, truth) for kind, found in instants]


def evaluated(kind: Kind, found: list[tuple[float, float]], truth: Truth) -> Crash:
    """Evaluate crashes, times [s] and loads, against the truth."""
    parts = [(truth.between(at - 1.0, at + WATCHED), at) for at, _ in found]
    times = [part.slack_after(at) for part, at in parts]
    begun = [part.let_go_after(at) for part, at in parts]
    return Crash(kind.name, kind.begins, times, begun, [load for _, load in found])


def _instant(bench: Rig, kind: Kind) -> tuple[float, float]:
    """Pull, trigger the crash and observe; return its time [s] and the load."""
    with bench.bridge() as bridge:
        bridge.pull([TENSION, 0.0], lambda: bench.bench.status["set_points"][0] > TENSION - 0.1)
        bench.drive(bridge, lambda _: np.array([TENSION, 0.0]), 0.2)
        at = time.monotonic()
        if kind.number is None:
            bench.bench.tell("unplug for=1.5")
        else:
            bridge.node.send(kind.number)
        bench.drive(bridge, lambda _: np.array([TENSION, 0.0]), WATCHED)
        return at, os.getloadavg()[0]
