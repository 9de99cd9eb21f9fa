"""`make bench-ik`: the inverse kinematics solver against plain FABRIKc and SciPy, on reachable targets drawn by a seed.

Every figure is of one core. The solver answers all targets; slow rivals answer a stated subsample of the same ones.
Results of the whole run overwrite docs/ik-benchmark.md; those of a run with any option changed are printed alone.
"""

from __future__ import annotations

import argparse
import math
import sys
from functools import partial
from pathlib import Path

import numpy as np

from continuum.kinematics.compiled.warm_up import warm_up
from continuum.whole_file import write_whole
from tools.bench_ik.rivals import damped_least_squares, fabrikc, scipy_least_squares
from tools.bench_ik.sample import draw, prototype_arm
from tools.bench_ik.scores import Score, quietest, score_helix, score_rival, score_solver
from tools.one_line import in_one_line

SECTIONS = (1, 2, 3, 5, 7)
BENDS = (90, 180)  # largest bend of a section of the targets [degrees]
TOLERANCES = (1e-4, 1e-6, 1e-8)  # [m] and [rad]
PAGE = Path("docs/ik-benchmark.md")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--targets", type=int, default=100_000, help="targets in all for every tolerance and start")
    parser.add_argument("--rivals", type=int, default=1000, help="targets of every kind for each rival that is slow")
    parser.add_argument("--slowest", type=int, default=100, help="the same for damped least squares")
    parser.add_argument("--seed", type=int, default=2018)
    options = parser.parse_args()
    warm_up()
    n = options.targets // (len(SECTIONS) * len(BENDS))
    head = "solved | median [us] | p99 [us] | iterations | p99 |\n|---|---|---|---|---|---|---|---|---|"
    worst = Goals()
    lines = [f"| sections | bends up to | start | tolerance | {head}"]
    rivals = [f"| sections | bends up to | solver | targets | {head}"]
    for n_sections in SECTIONS:
        for bend in BENDS:
            rng = np.random.default_rng([options.seed, n_sections, bend])
            sample = draw(prototype_arm(n_sections), math.radians(bend), n, rng)
            for from_random in (False, True):
                for tolerance in TOLERANCES:
                    score = quietest(partial(score_solver, sample, tolerance, from_random))
                    worst.note(n_sections, bend, tolerance, score)
                    start = "random" if from_random else "straight"
                    lines.append(f"| {n_sections} | {bend}° | {start} | {tolerance:g} | {score.cells()} |")
                    print(lines[-1], flush=True)
            for name, rival, count in (
                ("FABRIKc, 100 iterations", fabrikc(100), n),
                ("FABRIKc, 500 iterations", fabrikc(500), options.rivals),
                ("damped least squares", damped_least_squares, options.slowest),
                ("SciPy Levenberg-Marquardt", scipy_least_squares("lm"), options.rivals),
                ("SciPy trust region", scipy_least_squares("trf"), options.rivals // 3),
            ):
                if name.endswith("Marquardt") and n_sections > 3:
                    continue  # MINPACK takes no more unknowns than equations
                score = score_rival(sample, 1e-6, min(n, count), rival)
                rivals.append(f"| {n_sections} | {bend}° | {name} | {score.n} | {score.cells()} |")
                print(rivals[-1], flush=True)
    single, path, farthest = min((score_helix() for _ in range(3)), key=lambda scores: scores[0].median)
    text = page(options, n, lines, rivals, worst.lines(single), single, path, farthest)
    print("\n".join(worst.lines(single)))
    print(f"helix: {single.cells()} a call; {path.median:.1f} us a pose in one call; {farthest:.1e} m")
    if all(getattr(options, name) == parser.get_default(name) for name in vars(options)):
        write_whole(PAGE, text)
        print(f"written: {PAGE}")


class Goals:
    """The goals for the solver at 1e-6, and the worst that the run showed."""

    def __init__(self) -> None:
        self._solved = dict.fromkeys(BENDS, 1.0)
        self._median = self._p99 = 0.0

    def note(self, n_sections: int, bend: int, tolerance: float, score: Score) -> None:
        """Take one row into account."""
        if tolerance == 1e-6:
            self._solved[bend] = min(self._solved[bend], score.solved)
        if tolerance == 1e-6 and n_sections == 3:
            self._median, self._p99 = max(self._median, score.median), max(self._p99, score.p99)

    def lines(self, helix: Score) -> list[str]:
        """The table's lines."""
        solved = [
            (f"solved, bends up to {bend}°", f"{100 * goal:.2f} %", f"{100 * part:.4f} %", part >= goal)
            for bend, goal, part in ((90, 1.0, self._solved[90]), (180, 0.9999, self._solved[180]))
        ]
        times = [
            (name, f"{goal} us", f"{time:.1f} us", time <= goal)
            for name, goal, time in (
                ("median, three sections", 40, self._median),
                ("p99, three sections", 400, self._p99),
                ("helix, median of a call from the answer before (1e-9)", 10, helix.median),
            )
        ]
        rows = [(*row, "met" if met else "**missed**") for *row, met in (*solved, *times)]
        return ["| at 1e-6 | goal | worst row | |", "|---|---|---|---|", *(f"| {' | '.join(row)} |" for row in rows)]


def page(
    options: argparse.Namespace,
    n: int,
    lines: list[str],
    rivals: list[str],
    goals: list[str],
    single: Score,
    path: Score,
    farthest: float,
) -> str:
    """The page of results."""
    return f"""# Inverse kinematics benchmark

Made by `make bench-ik` (`--targets {options.targets} --rivals {options.rivals}
--slowest {options.slowest} --seed {options.seed}`). Targets are tip positions and directions of random postures, {n}
for every row, {options.targets} for every start and tolerance; sections are the prototype's (Table 1: five joints,
b = 19.25 mm), turned by 30 degrees each, with bend limits of 180 degrees. A target counts as solved when the solver
says so, the forward kinematics says so, and no section is bent beyond its limit. Times are processor time of single
Python calls, the making of the target and its checks included, on one core of a shared two-core machine that others
used at the same time: read them as ratios within the page. One call follows the other, answers are judged
afterwards. The solver is timed three times, and the quietest counts.

## Goals

{chr(10).join(goals)}

## The solver

{chr(10).join(lines)}

## Rivals, tolerance 1e-6, from the straight arm

The slow ones answer the first of the same targets, as many as stated; of fewer than 300 no p99 is told. All stop at
the same tolerance. SciPy's Levenberg-Marquardt (MINPACK) takes no more unknowns than equations, so it ends at three
sections. FABRIKc's legs grow without bound towards 180 degrees, so it bends a section by no more than 0.97 of that, and
what lies beyond it cannot reach alone. The others know no bend limits: what they bend beyond does not count as solved.

{chr(10).join(rivals)}

## Warm start along the helix

The demo's helix at 120 Hz, tolerance 1e-9, each pose from the answer before it: {single.median:.1f} us median and
{single.p99:.1f} us p99 a Python call, {path.median:.1f} us a pose when the whole path is one call (`follow`);
{single.iterations:.0f} iterations median; all solved: {"yes" if min(single.solved, path.solved) == 1.0 else "no"};
largest distance of the tip to the helix {farthest:.1e} m.
"""


if __name__ == "__main__":
    sys.exit(in_one_line(main))
