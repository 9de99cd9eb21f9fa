"""`make bench-dynamics`: the integrators on one release, longer arms, orders of convergence.

Times are processor times on one core, the shortest of several runs, which reduces the influence of other processes.
Writes its record and overwrites the tables of docs/numerics.md, or another folder with `--out`; `--quick` does not.
"""

from __future__ import annotations

import argparse
import os
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

if os.environ.get("OPENBLAS_NUM_THREADS") != "1":  # with two threads, small systems take ten times as long
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    os.execv(sys.executable, [sys.executable, "-m", "tools.benchmarks.dynamics", *sys.argv[1:]])

sys.path.append("out/bench_dynamics/extra")  # what `make bench-dynamics` installs for itself

from continuum.dynamics.integration.tolerances import Tolerances
from tools.benchmarks.dynamics import space
from tools.benchmarks.dynamics.growth import Size, measure
from tools.benchmarks.dynamics.orders import convergence, slope_error
from tools.benchmarks.dynamics.result import Result, Score, record_of
from tools.benchmarks.dynamics.rivals import rivals
from tools.benchmarks.dynamics.scene import cpu_time, prototype_release
from tools.benchmarks.report import DOCS, as_text, publish
from tools.one_line import in_one_line

SIZES = (5, 10, 20, 50, 100)


@dataclass(frozen=True)
class Effort:
    """Extent of the measurement: joints of the longer arms, and repetitions of a run by its length."""

    sizes: tuple[int, ...]
    slow: int
    fast: int


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="20 joints at most, a minute; keeps nothing")
    parser.add_argument("--out", type=Path, default=DOCS, help="folder of record and pages; default %(default)s")
    options = parser.parse_args()
    quick: bool = options.quick
    effort = Effort(SIZES[:3], 1, 5) if quick else Effort(SIZES, 3, 30)
    in_space = space.measure(effort.fast, list(space.ARMS)[: 2 if quick else None])
    record = record_of(Result(_scores(effort), _sizes(effort), convergence(), _slope_errors(), in_space))
    print(as_text(record))
    if not quick:
        publish(record, options.out)


def _scores(effort: Effort) -> list[Score]:
    scene, scores = prototype_release(), []
    exact = scene.converged()
    for rival in rivals(scene):
        seconds, theta = cpu_time(rival.run, effort.slow if "SciPy" in rival.name else effort.fast)
        sensitivities = None if rival.with_derivatives is None else cpu_time(rival.with_derivatives, effort.slow)[0]
        scores.append(Score(rival.name, seconds, float(np.degrees(np.abs(theta - exact).max())), sensitivities))
        print(f"{rival.name}: {1e3 * seconds:.1f} ms, {scores[-1].error:.4f} degrees", flush=True)
    return scores


def _sizes(effort: Effort) -> list[Size]:
    found = []
    for n in effort.sizes:
        found.append(measure(n, effort.slow if n < 100 else 1))
        print(f"{n} joints: compiled in {found[-1].compiling:.1f} s, {found[-1].per_second:.3f} s a second", flush=True)
    return found


def _slope_errors() -> dict[float, float]:
    """Return the largest error of the sensitivities by relative tolerance."""
    scene = prototype_release()
    return {relative: slope_error(scene, Tolerances(relative, relative / 10, 0.01)) for relative in (1e-4, 1e-5, 1e-6)}


if __name__ == "__main__":
    sys.exit(in_one_line(main))
