"""`make bench-discovery`: effects hidden in simulated measurements, and what `continuum diagnose` says of them.

It takes days: stop it by --rounds, --minutes, --cases or Ctrl-C; a further call goes on where this one stopped.
Every result is one line of data/discovery_benchmark.jsonl, kept in the repository so that a campaign goes on from
where the last one ended, on any machine; the page is made from all of them that the present
sources made, and overwrites docs/discovery-benchmark.md unless --out names another file.
"""

from __future__ import annotations

import argparse
import functools
import time
from collections.abc import Sequence
from itertools import islice
from pathlib import Path

from tools.bench_discovery.campaign import left, run_campaign, run_case
from tools.bench_discovery.digest import digest_of_sources
from tools.bench_discovery.page import page
from tools.bench_discovery.plans import CHOICES, campaign, narrowed
from tools.bench_discovery.result import Result, append, load, superseded
from tools.bench_discovery.score import judged, name_of

PAGE = Path("docs/discovery-benchmark.md")
RESULTS = Path("data/discovery_benchmark.jsonl")


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=float("inf"), help="after which no case is begun")
    parser.add_argument("--cases", type=int, help="of the whole campaign, those of earlier calls included")
    parser.add_argument("--rounds", type=int, default=20, help="of the whole campaign; default %(default)s")
    parser.add_argument("--only", nargs="+", default=[], choices=CHOICES, metavar="WHAT", help=", ".join(CHOICES))
    parser.add_argument("--jobs", type=int, default=2, help="cases at once; default %(default)s")
    parser.add_argument("--limit", type=float, default=1200.0, help="of one diagnosis [s]; default %(default)s")
    parser.add_argument("--seed", type=int, default=2027, help="of the campaign; default %(default)s")
    parser.add_argument("--accept-old", action="store_true", help="count results that other sources made too")
    parser.add_argument("--page-only", action="store_true", help="run no case")
    parser.add_argument("--results", type=Path, default=RESULTS, help="default %(default)s")
    parser.add_argument("--out", type=Path, default=PAGE, help="the page, which is overwritten; default %(default)s")
    options = parser.parse_args(arguments)
    digest = digest_of_sources()
    results = load(options.results, None if options.accept_old else digest)
    others = len(load(options.results, None)) - len(results)
    print(
        f"sources {digest}: {len(results)} results so far" + (f"; {others} of other sources set aside" * bool(others))
    )
    if not options.page_only:
        _go_on(options, digest, results)
    if results:
        options.out.write_text(page(results, superseded(options.results)), encoding="utf-8")
        print(f"written: {options.out}, from {len(results)} cases")


def _go_on(options: argparse.Namespace, digest: str, results: list[Result]) -> None:
    """Add what is still to be done to the results."""
    wanted = islice(narrowed(campaign(options.seed, options.rounds), options.only), options.cases)
    ends = time.monotonic() + 60 * options.minutes
    run = functools.partial(run_case, digest=digest, limit=options.limit)
    try:
        for result in run_campaign(left(wanted, results), options.jobs, run, lambda: time.monotonic() >= ends):
            append(result, options.results)
            results.append(result)
            print(_line(result, len(results)), flush=True)
    except KeyboardInterrupt:
        print("stopped; what is done is kept")


def _line(result: Result, number: int) -> str:
    where = f"{result.plan.size}, {result.plan.dataset}, noise {result.plan.noise}, seed {result.plan.seed}"
    return f"{number}. {name_of(result)} ({where}): {judged(result).value} {result.failure} {result.seconds:.0f} s"


if __name__ == "__main__":
    main()
