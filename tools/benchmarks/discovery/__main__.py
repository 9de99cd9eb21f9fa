"""`make bench-discovery`: effects hidden in simulated measurements, and their diagnosis by `continuum diagnose`.

Half of all cases are for development and may be inspected; the others (--half held-out) are run when a version is
finished, and the library is never tuned to them. Every result is one line of data/discovery_benchmark.jsonl; a further
call continues where this one was stopped by --minutes, --cases or Ctrl-C. The record summarises the results of the
present sources: of the held-out half if there are any, otherwise of the other half. The track record on the page of a
diagnosis uses the held-out half alone.
"""

from __future__ import annotations

import argparse
import signal
import sys
import threading
import time
from collections.abc import Sequence
from itertools import islice
from pathlib import Path

from tools.benchmarks.discovery.cases import compile_first, run_campaign
from tools.benchmarks.discovery.plans import CHOICES, HALVES, campaign, narrowed
from tools.benchmarks.discovery.result import Result, append, digest_of_sources, load
from tools.benchmarks.discovery.tables import record_of
from tools.benchmarks.discovery.track_record import write_track_record
from tools.benchmarks.report import DOCS, publish
from tools.one_line import in_one_line

RESULTS = Path("data/discovery_benchmark.jsonl")
RECORD = Path("continuum/continuum/discovery/report/track_record.json")


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--half", choices=HALVES, default=HALVES[0], help="default %(default)s")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="after which no case is begun")
    parser.add_argument("--cases", type=int, help="of the half, those of earlier calls included")
    parser.add_argument("--jobs", type=int, default=2, help="cases at once; default %(default)s")
    parser.add_argument("--only", nargs="+", default=[], choices=CHOICES, metavar="WHAT", help=", ".join(CHOICES))
    parser.add_argument("--page-only", action="store_true", help="run no case; make record and pages of those known")
    parser.add_argument("--results", type=Path, default=RESULTS, help="default %(default)s")
    parser.add_argument("--out", type=Path, default=DOCS, help="folder of record and pages; default %(default)s")
    parser.add_argument("--record", type=Path, default=RECORD, help="how often verdicts are right; default %(default)s")
    options = parser.parse_args(arguments)
    digest, everything = digest_of_sources(), load(options.results)
    results = [result for result in everything if result.digest == digest]
    print(f"sources {digest}: {len(results)} results so far, {len(everything) - len(results)} of other sources")
    if not options.page_only:
        _go_on(options, digest, results)
    if results:
        earlier = {one.digest for one in everything if one.digest != digest and one.plan.half == HALVES[1]}
        publish(record_of(results, len(earlier)), options.out)
    if write_track_record(results, options.record):
        print(f"written: {options.record}")


def _go_on(options: argparse.Namespace, digest: str, results: list[Result]) -> None:
    """Run the remaining cases and add their results."""
    done = {result.plan for result in results}
    wanted = islice(narrowed(campaign(options.half), options.only), options.cases)
    ends, stopped = time.monotonic() + 60 * options.minutes, threading.Event()

    def stop(*_: object) -> None:
        stopped.set()
        print("stopping when the cases that run are done; Ctrl-C again stops at once")
        signal.signal(signal.SIGINT, signal.default_int_handler)

    signal.signal(signal.SIGINT, stop)
    compile_first()
    left = (plan for plan in wanted if plan not in done)
    for result in run_campaign(left, options.jobs, digest, lambda: stopped.is_set() or time.monotonic() >= ends):
        append(result, options.results)
        results.append(result)
        what, last = " + ".join(result.plan.effects) or "nothing", result.failure.strip().splitlines()[-1:]
        print(
            f"{len(results)}. {what} ({result.plan}): {result.answer.value}, {result.seconds:.1f} s", *last, flush=True
        )


if __name__ == "__main__":
    sys.exit(in_one_line(main))
