"""`make bench-identification`: smoothing against the thesis's swarm, and a diagnosis's time; docs/identification.md.

Overwrites docs/identification.md, which is under version control, unless `--out` names another file.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from continuum.cli.diagnose import EXIT_CODES
from continuum.whole_file import write_whole
from tools.bench_identification.arms import eight_releases, measured_arm
from tools.bench_identification.page import Comparison, Diagnosed, goals, page
from tools.bench_identification.two_ways import by_smoothing, by_swarm
from tools.one_line import in_one_line

PAGE = Path("docs/identification.md")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arms", type=int, default=5, help="how many; default %(default)s")
    parser.add_argument("--seed", type=int, default=900, help="of the first arm; default %(default)s")
    parser.add_argument("--out", type=Path, default=PAGE, help="the page, which is overwritten; default %(default)s")
    options = parser.parse_args()
    compared = []
    for seed in range(options.seed, options.seed + options.arms):
        arm = measured_arm(seed)
        compared.append(Comparison(arm, by_smoothing(arm), by_swarm(arm, seed)))
        print(_line(compared[-1]), flush=True)
    diagnosed = _diagnosed(options.seed)
    for what, wanted, reached, met in goals(compared, diagnosed):
        print(f"{what}: {reached} (goal {wanted}), {met.strip('*')}")
    write_whole(options.out, page(compared, diagnosed))
    print(f"written: {options.out}")


def _line(one: Comparison) -> str:
    return (
        f"smoothing {one.smoothing.seconds:.1f} s; swarm {one.swarm.simulations} simulations, {one.swarm.seconds:.1f} s"
    )


def _diagnosed(seed: int) -> Diagnosed:
    with eight_releases(seed) as files, tempfile.TemporaryDirectory() as folder:
        verdict = Path(folder) / "verdict.json"
        command = ["continuum", "diagnose", "--json", str(verdict), *map(str, files)]
        began = time.perf_counter()
        code = subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode
        seconds = time.perf_counter() - began
        if code not in EXIT_CODES.values():
            raise RuntimeError(f"continuum diagnose ended with exit code {code}")
        return Diagnosed(seconds, json.loads(verdict.read_text(encoding="utf-8"))["verdict"])


if __name__ == "__main__":
    sys.exit(in_one_line(main))
