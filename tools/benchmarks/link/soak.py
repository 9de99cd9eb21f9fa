"""Long streaming, to detect growing memory of bridge and emulator."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tools.benchmarks.link.processes import Usage, core_share, slope, usage
from tools.benchmarks.link.rig import RATE, rig

PERIOD = 5.0
"""Time between two readings of the memory [s]."""

SETTLING = 0.2
"""Fraction of the run that does not count, because buffers of fixed length still fill."""


@dataclass(frozen=True)
class Memory:
    """Memory of one process: settled and final [MiB], growth in an hour at 60 Hz [MiB], and fraction of one core."""

    settled: float
    last: float
    growth: float
    core: float


@dataclass(frozen=True)
class Soak:
    """One run.

    Attributes:
        minutes: duration [min].
        rate: requested rate of the sensors [Hz].
        reached: mean number of joint states per second.
        load: average load of the machine over the run.
        lost: number of frames that the bridge counts as lost.
        bridge, emulator: memory of the two processes.
    """

    minutes: float
    rate: float
    reached: float
    load: float
    lost: int
    bridge: Memory
    emulator: Memory

    @property
    def hours(self) -> float:
        """Hours of streaming at 60 Hz with the same number of frames."""
        return self.minutes / 60.0 * self.reached / RATE


def measure(minutes: float, rate: float, folder: Path) -> Soak:
    """Stream at a rate [Hz] while the cables are pulled gently in turn."""
    readings: tuple[list[Usage], list[Usage]] = [], []
    loads, received = [], 0
    with rig(folder, "--rate", str(rate)) as bench, bench.bridge() as bridge:
        bench.latency_probe.clear()
        pids = bridge.node.process.pid, bench.bench.process.process.pid
        begin = time.monotonic()
        while time.monotonic() - begin < 60.0 * minutes:
            for pid, seen in zip(pids, readings, strict=True):
                seen.append(usage(pid))
            loads.append(os.getloadavg()[0])
            bench.drive(bridge, lambda t: 4.0 * np.array([1.0 - np.cos(t), 0.0]), PERIOD)
            received += len(bench.latency_probe.joints)
            bench.latency_probe.clear()
            if len(loads) % 12 == 0:
                memory = ", ".join(f"{seen[-1].memory / 1024:.1f} MiB" for seen in readings)
                lasted = time.monotonic() - begin
                print(f"  {lasted / 60:.0f} min, {received / lasted:.0f} Hz: {memory}", flush=True)
        lasted = time.monotonic() - begin
        bridge.probe.wait_for_report(f"{bridge.name}: link")
        lost = int(bridge.diagnostic("link")["frames lost"])
    reached = received / lasted
    of_bridge, of_emulator = (memory_of(seen, reached / RATE) for seen in readings)
    return Soak(lasted / 60.0, rate, reached, float(np.mean(loads)), lost, of_bridge, of_emulator)


def memory_of(seen: list[Usage], speed: float) -> Memory:
    """Evaluate readings of a process that did ``speed`` times the work of live streaming."""
    settled = seen[int(SETTLING * len(seen)) :]
    times, memory = (
        np.array([getattr(reading, name) for reading in settled], dtype=float) for name in ("at", "memory")
    )
    growth = slope(times, memory) * 3600.0 / speed / 1024.0
    return Memory(float(memory[0] / 1024), float(memory[-1] / 1024), growth, core_share(settled[0], settled[-1]))
