"""The viewer as a process, with a client, and its processor time."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from harness import NodeProcess, ended_in_any_case

from tools.benchmarks.link.processes import core_share, usage
from tools.benchmarks.viewer.moving_arm import MovingArm

SETTLING = 5.0
"""Time for a viewer and its client to start [s]."""


@dataclass(frozen=True)
class Load:
    """Load of one process over a time.

    Attributes:
        core: fraction of one core.
        frames: frames per second [Hz].
    """

    core: float
    frames: float


@contextmanager
def viewer(arm_file: Path, moving: MovingArm, domain: int, looked_at: bool = True) -> Iterator[NodeProcess]:
    """Run a viewer on a free port while the arm moves."""
    node = NodeProcess("continuum_manipulator", "viewer", domain, files=(arm_file,), parameters={"port": 0})
    with ended_in_any_case(node):
        moving.probe.wait_for_report("viewer")
        address = moving.probe.report("viewer")["address"]
        looker = (
            subprocess.Popen([sys.executable, "-m", "tools.benchmarks.viewer.looker", address]) if looked_at else None
        )
        try:
            moving.run(SETTLING)
            yield node
        finally:
            if looker is not None:
                looker.kill()
                looker.wait()
            node.stop()


def measured_load(node: NodeProcess, moving: MovingArm, duration: float) -> Load:
    """Return the load of the viewer while the arm moves for a ``duration`` [s]."""
    moving.probe.wait_for_report("viewer")
    frames, before = moving.probe.count("viewer", "frames"), usage(node.process.pid)
    moving.run(duration)
    moving.probe.wait_for_report("viewer")
    after = usage(node.process.pid)
    frames = moving.probe.count("viewer", "frames") - frames
    return Load(core_share(before, after), frames / (after.at - before.at))
