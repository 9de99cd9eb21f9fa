"""`make bench-viewer`: processor time of the viewer, and latency of other nodes with and without it.

The record of a complete run is written and shown in docs/viewer.md; that of a run with changed options is only printed.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml
from domain_coordinator import domain_id
from harness import NodeProcess, running

from continuum.arm import Arm, arm_to_mapping
from continuum.arrays import Array
from continuum.viewer.default_arm import default_arm
from tools.benchmarks.record import Figure, Record, Table
from tools.benchmarks.report import as_text, publish
from tools.benchmarks.viewer.moving_arm import RATE, MovingArm
from tools.benchmarks.viewer.viewer_process import SETTLING, Load, measured_load, viewer
from tools.one_line import in_one_line

SECTIONS = (1, 3, 10)
LISTENERS = 3
"""Number of section nodes whose answers are timed; ten of them would use two cores completely."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0, help="of each measurement")
    parser.add_argument("--turns", type=int, default=5, help="with and without the viewer, in turn")
    options = parser.parse_args()
    with domain_id() as domain:
        loads = processor_time(domain, options.seconds)
        record = record_of(loads, others(domain, options.seconds, options.turns))
    print(as_text(record), flush=True)
    if all(value == parser.get_default(name) for name, value in vars(options).items()):
        publish(record)


@dataclass(frozen=True)
class Latencies:
    """Median and 99th percentile of each turn, (turns, 2) [s], without a viewer and with one; answers lost."""

    without: Array
    viewed: Array
    lost: int


def record_of(loads: Mapping[tuple[int, bool], Load], latencies: Latencies) -> Record:
    """Return the record of the viewer's loads by sections and with or without a client, and of others' latencies."""
    medians = {name: np.median(getattr(latencies, name), axis=0) for name in ("without", "viewed")}
    change = 100 * (medians["viewed"][1] / medians["without"][1] - 1)
    figures = (
        Figure("viewer of three sections, one browser: part of one core", 100 * loads[3, True].core, "%", at_most=25),
        Figure("latency of other nodes with a viewer: change of the 99 % quantile", change, "%", at_most=20),
        Figure("answers of other nodes lost with and without a viewer", latencies.lost),
    )
    rows = [
        (n, "one" if looked_at else "none", f"{load.frames:.1f}", f"{100 * load.core:.1f} %")
        for (n, looked_at), load in loads.items()
    ]
    late = [
        (
            {"without": "without", "viewed": "with"}[name],
            *(f"{1e3 * value:.2f} ms" for value in medians[name]),
            ", ".join(f"{1e3 * value:.2f}" for value in getattr(latencies, name)[:, 1]),
        )
        for name in medians
    ]
    tables = {
        "load": Table.of(("sections", "browsers", "frames a second", "of one core"), rows),
        "latency": Table.of(("viewer", "latency, median", "latency, 99 %", "99 % in each turn [ms]"), late),
    }
    return Record("viewer", "make bench-viewer", figures, tables)


def processor_time(domain: int, seconds: float) -> dict[tuple[int, bool], Load]:
    """Return the loads by sections, with and without a client."""
    loads = {}
    for n in SECTIONS:
        with arm_on_disk(n) as (arm, file), moving(arm, domain) as arm_in_motion:
            for looked_at in (True, False):
                with viewer(file, arm_in_motion, domain, looked_at) as node:
                    loads[n, looked_at] = measured_load(node, arm_in_motion, seconds)
    return loads


def others(domain: int, seconds: float, turns: int) -> Latencies:
    """Measure the latency of section nodes alternately with and without a viewer."""
    found: dict[bool, list[tuple[float, float]]] = {True: [], False: []}
    with arm_on_disk(10) as (arm, file), ExitStack() as held:
        names = range(1, LISTENERS + 1)
        sections = [
            NodeProcess(
                "continuum_manipulator",
                "section",
                domain,
                name=f"section_{i}",
                files=(file,),
                parameters={"section": i},
            )
            for i in names
        ]
        held.enter_context(running(*sections))
        arm_in_motion = held.enter_context(moving(arm, domain))
        arm_in_motion.probe.wait_for_nodes(*(f"section_{i}" for i in names))
        arm_in_motion.run(SETTLING)
        expected = LISTENERS * int(seconds * RATE)
        lost = 0
        for _ in range(turns):
            for there in (False, True):
                with viewer(file, arm_in_motion, domain) if there else ExitStack():
                    arm_in_motion.probe.listen_until_quiet()
                    arm_in_motion.latencies.clear()
                    arm_in_motion.run(seconds)
                    arm_in_motion.probe.listen_until_quiet()
                    lost += expected - len(arm_in_motion.latencies)
                    found[there].append(tuple(np.quantile(arm_in_motion.latencies, (0.5, 0.99))))
                arm_in_motion.run(SETTLING)
    return Latencies(np.array(found[False]), np.array(found[True]), lost)


@contextmanager
def arm_on_disk(n_sections: int) -> Iterator[tuple[Arm, Path]]:
    """Return an arm with ``n_sections`` sections, and its parameter file."""
    arm = default_arm(n_sections)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "arm.yaml"
        content = {"/**": {"ros__parameters": {"arm": arm_to_mapping(arm)}}}
        file.write_text(yaml.safe_dump(content), encoding="utf-8")
        yield arm, file


@contextmanager
def moving(arm: Arm, domain: int) -> Iterator[MovingArm]:
    """Run the moving arm during the block."""
    arm_in_motion = MovingArm(arm, domain)
    with arm_in_motion.probe:
        yield arm_in_motion


if __name__ == "__main__":
    sys.exit(in_one_line(main))
