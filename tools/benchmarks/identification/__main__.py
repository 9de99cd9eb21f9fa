"""`make bench-identification`: the library's fit and the thesis's swarm on the same releases.

Keeps its record and overwrites the tables of docs/identify.md, unless `--out` names another folder.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from tools.benchmarks.identification.answers import by_fit, by_swarm
from tools.benchmarks.identification.arms import measured_arm
from tools.benchmarks.identification.comparison import Comparison, record_of
from tools.benchmarks.report import DOCS, as_text, publish
from tools.one_line import in_one_line


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arms", type=int, default=5, help="how many; default %(default)s")
    parser.add_argument("--seed", type=int, default=900, help="of the first arm; default %(default)s")
    parser.add_argument("--out", type=Path, default=DOCS, help="folder of record and pages; default %(default)s")
    options = parser.parse_args()
    compared = []
    for seed in range(options.seed, options.seed + options.arms):
        arm = measured_arm(seed)
        compared.append(Comparison(by_fit(arm), by_swarm(arm, seed)))
        fit, swarm = compared[-1].fit, compared[-1].swarm
        worst = [f"{100 * max(map(abs, one.errors)):.1f} %" for one in (fit, swarm)]
        print(f"arm {seed}: fit {fit.seconds:.1f} s, worst {worst[0]}; swarm {swarm.seconds:.1f} s, worst {worst[1]}")
    record = record_of(compared)
    print(as_text(record))
    publish(record, options.out)


if __name__ == "__main__":
    sys.exit(in_one_line(main))
