"""`make seeded-faults`: put each fault of the list into a copy of the checkout, and report those that no test finds."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

from tools.benchmarks.record import Figure, Record, Table
from tools.benchmarks.report import publish
from tools.benchmarks.seeded_faults.copy_of_checkout import CopyOfCheckout
from tools.benchmarks.seeded_faults.table import Fault, read_faults

ROOT = Path(__file__).parents[3]
TABLE = Path(__file__).with_name("faults.toml")
KILLED, SURVIVED, BROKEN = "killed", "survived", "broken entry"


def main(arguments: list[str] | None = None, root: Path = ROOT, table: Path = TABLE) -> int:
    """Try all faults; return 1 if one survives, an entry is broken, or a test that found one also fails without it."""
    parser = argparse.ArgumentParser(prog="make seeded-faults ARGS=...", description=__doc__)
    parser.add_argument("--only", default="", metavar="TEXT", help="faults in files whose path has this text")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="at a time; default %(default)s")
    options = parser.parse_args(arguments)
    faults = [fault for fault in read_faults(table) if options.only in fault.path]
    found: dict[str, str] = {}
    outcomes: list[tuple[Fault, str]] = []
    with tempfile.TemporaryDirectory(prefix="seeded_faults_") as folder:
        copies: SimpleQueue[CopyOfCheckout] = SimpleQueue()
        for number in range(options.jobs):
            copies.put(CopyOfCheckout(root, Path(folder, str(number))))

        def tried(fault: Fault) -> tuple[str, str]:
            """Return the outcome and the test that found the fault; distant tests run if the nearest find nothing."""
            if problem := fault.problem(root):
                return BROKEN, problem
            copy = copies.get()
            try:
                failures = copy.failures_with(fault, fault.tests[:1])
                if not failures and fault.tests[1:]:
                    failures = copy.failures_with(fault, fault.tests[1:])
            finally:
                copies.put(copy)
            return (KILLED, failures[0]) if failures else (SURVIVED, "")

        with ThreadPoolExecutor(options.jobs) as pool:
            for fault, (outcome, by) in zip(faults, pool.map(tried, faults), strict=True):
                outcomes.append((fault, outcome))
                found |= {by: str(fault)} if outcome == KILLED else {}
                print(f"{outcome:<12} {fault} ({by})", flush=True)
        blind = copies.get().failures(list(found)) if found else []
    for test in blind:
        print(f"{test} fails without a fault too: it does not find {found.get(test, 'one')}", file=sys.stderr)
    print_summary(outcomes)
    if (root, table, options.only) == (ROOT, TABLE, ""):
        publish(record_of(outcomes))
    return int(bool(blind) or any(outcome != KILLED for _, outcome in outcomes))


def record_of(outcomes: Sequence[tuple[Fault, str]]) -> Record:
    """Return the record of the fraction of faults that is found, and of those that are not."""
    found, n = sum(outcome == KILLED for _, outcome in outcomes), len(outcomes)
    rows = [(outcome, fault.path, fault) for fault, outcome in outcomes if outcome != KILLED]
    figure = Figure("seeded faults that a test finds", 100 * found / n, "%", at_least=100, n=n)
    return Record(
        "seeded-faults", "make seeded-faults", (figure,), {"not found": Table.of(("", "file", "fault"), rows)}
    )


def print_summary(outcomes: list[tuple[Fault, str]]) -> None:
    """Print the number of faults by outcome and package."""
    counts = Counter((name, outcome) for fault, outcome in outcomes for name in (fault.package, "all"))
    print(f"\n{'':<32}" + "".join(f"{outcome:>14}" for outcome in (KILLED, SURVIVED, BROKEN)))
    for name in [*sorted({fault.package for fault, _ in outcomes}), "all"]:
        print(f"{name:<32}" + "".join(f"{counts[name, outcome]:>14}" for outcome in (KILLED, SURVIVED, BROKEN)))


if __name__ == "__main__":
    sys.exit(main())
