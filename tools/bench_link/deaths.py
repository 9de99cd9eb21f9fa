"""The bridge is killed or hangs, or the port goes, while a cable is tight: how long until it is slack."""

from __future__ import annotations

import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from emulated_bench import Bridge

from continuum_hw_imu.protocol.messages import ReceiverLimits
from tools.bench_link.rig import Rig, rig
from tools.bench_link.truth import Truth, load_truth

TENSION = 10.0
"""At that instant [N]."""

WATCHED = 2.0
"""Time for which it is watched after [s]."""

LIMITS = ReceiverLimits()

TICK = 1 / 60
"""Between two rows of the truth [s]."""


@dataclass(frozen=True)
class Death:
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


KINDS = {
    "killed (SIGKILL)": 0.0,
    "killed, and the closed port is not seen": LIMITS.heartbeat_timeout,
    "hangs (SIGSTOP)": LIMITS.heartbeat_timeout,
    "port unplugged": 0.0,
}
"""When the receiver begins to let go [s]: the port is seen to close, or the heartbeats stop."""


def measure(folder: Path, repetitions: int) -> list[Death]:
    """Each so many times, each time with a bridge that begins anew."""
    seeing = [kind for kind in KINDS if "not seen" not in kind]
    blind = [kind for kind in KINDS if "not seen" in kind]
    return [
        death
        for hang_up, kinds in ((True, seeing), (False, blind))
        for death in _measure_all(folder, hang_up, kinds, repetitions)
    ]


def _measure_all(folder: Path, hang_up: bool, kinds: list[str], repetitions: int) -> list[Death]:
    instants: dict[str, list[tuple[float, float]]] = {kind: [] for kind in kinds}
    with rig(folder, *([] if hang_up else ["--no-hang-up"])) as bench:
        for kind in kinds:
            for _ in range(repetitions):
                with bench.bridge() as bridge:
                    instants[kind].append((_end_it(bench, bridge, kind), os.getloadavg()[0]))
            print(f"  {kind}", flush=True)
    truth = load_truth(bench.truth_file)
    return [evaluated(kind, found, truth) for kind, found in instants.items()]


def evaluated(kind: str, found: list[tuple[float, float]], truth: Truth) -> Death:
    """Beside the truth: instants [s] at which it happened, and the load then."""
    parts = [(truth.between(at - 1.0, at + WATCHED), at) for at, _ in found]
    times = [part.slack_after(at) for part, at in parts]
    begun = [part.let_go_after(at) for part, at in parts]
    return Death(kind, KINDS[kind], times, begun, [load for _, load in found])


def _end_it(bench: Rig, bridge: Bridge, kind: str) -> float:
    """Pull, let it happen, and watch; the instant [s]."""
    bridge.pull([TENSION, 0.0], lambda: bench.bench.status["set_points"][0] > TENSION - 0.1)
    bench.drive(bridge, lambda _: np.array([TENSION, 0.0]), 0.2)
    at = time.monotonic()
    if kind.startswith("port"):
        bench.bench.tell("unplug for=1.5")
    else:
        bridge.node.send(signal.SIGSTOP if kind.startswith("hangs") else signal.SIGKILL)
    bench.drive(bridge, lambda _: np.array([TENSION, 0.0]), WATCHED)
    return at
