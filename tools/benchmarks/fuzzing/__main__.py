"""`make fuzz`: random, mutated and coverage-guided bytes through both parsers of the bench protocol.

Writes its record. The exit code is 1 if a frame was accepted that was never sent, or too much tension was let through;
an exception of a parser ends with a traceback.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

from tools.benchmarks.fuzzing.campaign import LIMITS, run
from tools.benchmarks.fuzzing.figures import record_of
from tools.benchmarks.fuzzing.line import WAYS
from tools.benchmarks.report import DOCS, publish
from tools.one_line import in_one_line

EXTRA = "out/fuzz/extra"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bytes", type=int, default=10_000_000, help="in each way; default %(default)s")
    parser.add_argument("--out", type=Path, default=DOCS, help="folder of record and pages; default %(default)s")
    options = parser.parse_args()
    tallies = []
    for way, blocks in WAYS.items():
        tallies.append(run(way, blocks(np.random.default_rng(1)), options.bytes))
        print(f"{way}: {tallies[-1].size} bytes, {tallies[-1].accepted} frames accepted", flush=True)
    guided = _guided(options.bytes)
    publish(record_of(tallies, guided), options.out)
    return int(any(tally.never_sent or tally.largest_tension > LIMITS.max_tension for tally in tallies))


def _guided(size: int) -> dict[str, int] | None:
    """Return the result of the coverage-guided search; None if its engine is not installed."""
    sys.path.append(EXTRA)
    if importlib.util.find_spec("atheris") is None:
        print("atheris is not installed; the coverage-guided search is left out", file=sys.stderr)
        return None
    result = Path("out/fuzz/guided.json")
    result.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, "-m", "tools.benchmarks.fuzzing.guided", str(size), str(result)], check=True)
    found: dict[str, int] = json.loads(result.read_text(encoding="utf-8"))
    print(f"coverage-guided: {found['size']} bytes in {found['inputs']} inputs", flush=True)
    return found


if __name__ == "__main__":
    sys.exit(in_one_line(main))
