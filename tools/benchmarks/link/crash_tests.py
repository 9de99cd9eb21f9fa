"""The bridge is killed or hangs, or the port goes, while a cable is tight: how long until it is slack."""

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
"""At that instant [N]."""

WATCHED = 2.0
"""Time for which it is watched after [s]."""

LIMITS = ReceiverLimits()

TICK = 1 / RATE
"""Between two rows of the truth [s]."""


@dataclass(frozen=True)
class Crash:
    """One way to go.

    Attributes:
        name: in words.
        begins: docs/bench-protocol.md's time until the receiver begins to let go at the latest [s].
        times: until all set points are zero for good, of each repetition [s].
        begun: until the receiver began to let go, of each [s].
        loads: average load of the machine in the last minute, at each.
    """

    name: str
    begins: float
    times: list[float]
    begun: list[float]
    loads: list[float]

    @property
    def stated(self) -> float:
        """Time until slack [s]."""
        return self.begins + LIMITS.slack_time


@dataclass(frozen=True)
class Kind:
    """What happens.

    Attributes:
        name: in words.
        begins: time until the receiver begins to let go at the latest [s]: the port is seen to close, or
            heartbeats stop.
        number: signal that the bridge is sent; None where the port is unplugged.
        is_seen: whether the emulator notices that the port is closed.
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
    """Each so many times, each time with a bridge that begins anew."""
    return [crash for is_seen in (True, False) for crash in _measure_all(folder, is_seen, repetitions)]


def _measure_all(folder: Path, is_seen: bool, repetitions: int) -> list[Crash]:
    """Those of one emulator."""
    instants: list[tuple[Kind, list[tuple[float, float]]]] = []
    with rig(folder, *([] if is_seen else ["--no-hang-up"])) as bench:
        for kind in KINDS:
            if kind.is_seen is is_seen:
                instants.append((kind, [_instant(bench, kind) for _ in range(repetitions)]))
                print(f"  {kind.name}", flush=True)
    truth = load_truth(bench.truth_file)
    return [evaluated(kind, found, truth) for kind, found in instants]


def evaluated(kind: Kind, found: list[tuple[float, float]], truth: Truth) -> Crash:
    """Beside the truth: instants [s] at which it happened, and the load then."""
    parts = [(truth.between(at - 1.0, at + WATCHED), at) for at, _ in found]
    times = [part.slack_after(at) for part, at in parts]
    begun = [part.let_go_after(at) for part, at in parts]
    return Crash(kind.name, kind.begins, times, begun, [load for _, load in found])


def _instant(bench: Rig, kind: Kind) -> tuple[float, float]:
    """Pull, let it happen, and watch; the instant [s], and the load then."""
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
