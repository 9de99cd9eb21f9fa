"""The command line: selection of the parts, and their record."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import tools.benchmarks.link
from continuum.errors import ContinuumError
from tools.benchmarks.link import campaign, closed_loop, crash_tests, soak, starvation
from tools.benchmarks.link.faults import CASES, FAULTS
from tools.benchmarks.link.processes import take_niceness
from tools.benchmarks.link.results import keep, load, together
from tools.benchmarks.link.tables import record_of
from tools.benchmarks.report import DOCS, publish


def main(arguments: list[str] | None = None) -> int:
    """Run the parts, and write the record of all stored results."""
    parser = argparse.ArgumentParser(prog="make bench-link ARGS=...", description=tools.benchmarks.link.__doc__)
    add = parser.add_argument
    add("--minutes", type=float, default=10.0, help="of the closed loop; default %(default)g")
    add("--repetitions", type=int, default=5, help="of each death; default %(default)s")
    add(
        "--faults",
        nargs="+",
        choices=FAULTS,
        default=[],
        metavar="NAME",
        help="of the campaign: cases of these only, beside those kept: %(choices)s",
    )
    add("--starved-seconds", type=float, default=30.0, help="of each way to starve the bridge; default %(default)g")
    add("--soak-minutes", type=float, default=60.0, help="default %(default)g")
    add("--soak-rate", type=float, default=60.0, metavar="HZ", help="of the sensors then; default %(default)g")
    add("--niceness", type=int, default=os.getpriority(os.PRIO_PROCESS, 0), metavar="N",
        help="of all its processes and their session; below 0 takes a privilege")  # fmt: skip
    add("--out", type=Path, default=Path("out/bench_link"), metavar="FOLDER", help="default %(default)s")
    add("--docs", type=Path, default=DOCS, metavar="FOLDER", help="of record and pages; default %(default)s")
    add(
        "parts",
        nargs="*",
        metavar="PART",
        help="closed, campaign, crash_tests, starvation, soak or page (no run); default all",
    )
    options = parser.parse_args(arguments)
    runs: dict[str, Callable[[Path], Any]] = {
        "closed": lambda folder: [*(load(options.out).closed or []), closed_loop.measure(options.minutes, folder)],
        "campaign": lambda folder: together(
            load(options.out).campaign if options.faults else None, campaign.measure(folder, _cases(options.faults))
        ),
        "crash_tests": lambda folder: crash_tests.measure(folder, options.repetitions),
        "starvation": lambda folder: starvation.measure(folder, options.starved_seconds),
        "soak": lambda folder: soak.measure(options.soak_minutes, options.soak_rate, folder),
    }
    parts = options.parts or list(runs)
    strange = set(parts) - {*runs, "page"}
    if strange:
        parser.error(f"no such part: {', '.join(sorted(strange))}; allowed: {', '.join(runs)}, page")
    options.out.mkdir(parents=True, exist_ok=True)
    take_niceness(options.niceness)
    try:
        for part, run in runs.items():
            if part in parts:
                print(part, flush=True)
                keep(options.out, part, run((options.out / part).resolve()), options.niceness)
        publish(record_of(load(options.out)), options.docs)
    except (ContinuumError, AssertionError) as error:  # AssertionError: a time-out in the tests' harness
        print(f"bench-link: {error}", file=sys.stderr)
        return 1
    return 0


def _cases(names: list[str]) -> list[tuple[str, ...]]:
    """Return the cases that consist of these faults only; without names, all cases."""
    return [case for case in CASES if not names or set(case) <= set(names)]
