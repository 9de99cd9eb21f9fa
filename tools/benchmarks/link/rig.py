"""Emulated bench, calibrated bridge and subscriber, set up for a measurement and ended in any case."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from domain_coordinator import domain_id
from emulated_bench import Bridge, EmulatedBench, bridge_at, emulated_bench
from harness import Probe

from continuum.arrays import Array
from tools.benchmarks.link.latency_probe import LatencyProbe
from tools.demo.folder import claimed

RATE = 60.0
"""Live rate of the sensors [Hz]."""

COMMAND_PERIOD = 1 / 30
"""Time between two tension commands [s]."""

CALIBRATION, SENT = "sensors.yaml", "sent.csv"
FILES = "port", "control", "truth.csv", CALIBRATION, SENT
"""File in the folder of a measurement."""

Pull = Callable[[float], Array]
"""Function from the time since some instant [s] to the tension of each cable [N]."""


@dataclass(frozen=True)
class Rig:
    """Equipment of a measurement.

    Attributes:
        domain: ROS domain.
        folder: folder of the emulator's files.
        bench: the emulator's process.
        latency_probe: node that measures delays.
    """

    domain: int
    folder: Path
    bench: EmulatedBench
    latency_probe: LatencyProbe

    @property
    def calibration(self) -> Path:
        return self.folder / CALIBRATION

    @property
    def truth_file(self) -> Path:
        return self.bench.truth_file

    @property
    def sent_file(self) -> Path:
        return self.folder / SENT

    def calibrate(self) -> None:
        """Calibrate the sensors and write their calibration file."""
        with bridge_at(self.latency_probe, self.bench, self.domain, calibration=self.calibration) as bridge:
            bridge.wait_for_state("inactive")
            bridge.calibrate()
            bridge.node.stop()
        self.wait_for_free_port()

    def wait_for_free_port(self) -> None:
        self.latency_probe.probe.wait_until(lambda: not self.bench.status["open"], "a free port")

    @contextmanager
    def bridge(self, **parameters: object) -> Iterator[Bridge]:
        """Run an active bridge with that calibration, and wait for its joint states."""
        self.wait_for_free_port()
        given = {"calibration": self.calibration, "keep_bias": True, "autostart": "activate", **parameters}
        with bridge_at(self.latency_probe, self.bench, self.domain, **given) as bridge:
            bridge.wait_for_state("active")
            self.wait_for_joints(bridge)
            yield bridge

    def wait_for_joints(self, bridge: Bridge) -> None:
        """Wait for new joint states."""
        before = len(self.latency_probe.joints)
        bridge.probe.wait_until(
            lambda: len(self.latency_probe.joints) > before + 5, lambda: f"states; {bridge.diagnostic('angles')}"
        )

    def drive(self, bridge: Bridge, pull: Pull | None, lasts: float) -> None:
        """Command tensions (None: nothing) and process messages for a time [s]."""
        begin = due = time.monotonic()

        def over() -> bool:
            nonlocal due
            now = time.monotonic()
            if pull is not None and now >= due:
                bridge.command(pull(now - begin))
                due += COMMAND_PERIOD * max(1.0, np.ceil((now - due) / COMMAND_PERIOD))
            return now - begin >= lasts

        while not over():
            bridge.probe.spin(COMMAND_PERIOD / 4)


@contextmanager
def rig(folder: Path, *options: str) -> Iterator[Rig]:
    """Run an emulated bench in a separate ROS domain with calibrated sensors; ``options`` are those of the emulator.

    Raises:
        DemoError: another measurement uses the folder.
    """
    with (
        claimed(folder, FILES),
        domain_id() as domain,
        Probe(domain, "bench_link") as probe,
        emulated_bench(domain, folder, "--sent", str(folder / SENT), *options) as bench,
    ):
        found = Rig(domain, folder, bench, LatencyProbe(probe))
        found.calibrate()
        yield found
