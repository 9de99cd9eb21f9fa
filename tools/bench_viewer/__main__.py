"""`make bench-viewer`: processor time of the viewer, and latency of other nodes with and without it.

Results of the whole run overwrite the tables of docs/viewer.md; those of a run with options changed are printed alone.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np
import yaml
from domain_coordinator import domain_id
from harness import NodeProcess, running

from continuum.arm import Arm, arm_to_mapping
from continuum.viewer.default_arm import default_arm
from tools.bench_viewer.moving_arm import RATE, MovingArm
from tools.bench_viewer.viewer_process import SETTLING, measured_load, viewer
from tools.markdown import paragraph, replace_between, table
from tools.one_line import in_one_line

PAGE = Path("docs/viewer.md")
BEGIN, END = "<!-- made by `make bench-viewer` -->", "<!-- end -->"
LISTENERS = 3
"""Section nodes whose answers are timed; ten of them keep two cores busy by themselves."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0, help="of each measurement")
    parser.add_argument("--turns", type=int, default=5, help="with and without the viewer, in turn")
    options = parser.parse_args()
    with domain_id() as domain:
        text = "\n\n".join([processor_time(domain, options.seconds), others(domain, options.seconds, options.turns)])
    print(text, flush=True)
    if all(value == parser.get_default(name) for name, value in vars(options).items()):
        replace_between(PAGE, BEGIN, END, text)
        print(f"written: {PAGE}")


def processor_time(domain: int, seconds: float) -> str:
    """A table by sections, with somebody who looks and without."""
    rows = []
    for n in (1, 3, 10):
        with arm_on_disk(n) as (arm, file), moving(arm, domain) as arm_in_motion:
            for looked_at in (True, False):
                with viewer(file, arm_in_motion, domain, looked_at) as node:
                    load = measured_load(node, arm_in_motion, seconds)
                who = "one" if looked_at else "none"
                rows.append((n, who, f"{load.frames:.1f}", f"{100 * load.core:.1f} %"))
    return table(("sections", "browsers", "frames a second", "of one core"), rows)


def others(domain: int, seconds: float, turns: int) -> str:
    """Latency of section nodes with and without a viewer, in turn."""
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
    medians = {there: np.median(values, axis=0) for there, values in found.items()}
    rows = [
        (
            "with" if there else "without",
            f"{1e3 * medians[there][0]:.2f} ms",
            f"{1e3 * medians[there][1]:.2f} ms",
            ", ".join(f"{1e3 * late:.2f}" for _, late in values),
        )
        for there, values in sorted(found.items())
    ]
    change = medians[True][1] / medians[False][1] - 1
    words = paragraph(
        f"The 99 % quantile changes by {100 * change:+.0f} % (medians of {turns} turns of {seconds:g} s each);",
        f"{lost} answers were lost.",
    )
    head = ("viewer", "latency, median", "latency, 99 %", "99 % in each turn [ms]")
    return f"{table(head, rows)}\n\n{words}"


@contextmanager
def arm_on_disk(n_sections: int) -> Iterator[tuple[Arm, Path]]:
    """An arm of so many sections, and its parameter file."""
    arm = default_arm(n_sections)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "arm.yaml"
        content = {"/**": {"ros__parameters": {"arm": arm_to_mapping(arm)}}}
        file.write_text(yaml.safe_dump(content), encoding="utf-8")
        yield arm, file


@contextmanager
def moving(arm: Arm, domain: int) -> Iterator[MovingArm]:
    """The arm in motion."""
    arm_in_motion = MovingArm(arm, domain)
    with arm_in_motion.probe:
        yield arm_in_motion


if __name__ == "__main__":
    sys.exit(in_one_line(main))
