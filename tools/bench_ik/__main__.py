"""`make bench-ik`: the inverse kinematics solver against plain FABRIKc and SciPy, on reachable targets drawn by a seed.

Every figure is of one core. The solver answers all targets; slow rivals answer a stated subsample of the same ones.
Results go to docs/ik-benchmark.md.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np

from continuum.kinematics.compiled.warm_up import warm_up
from tools.bench_ik.rivals import damped_least_squares, fabrikc, scipy_least_squares
from tools.bench_ik.sample import draw, prototype_arm
from tools.bench_ik.scores import Score, score_helix, score_rival, score_solver

SECTIONS = (1, 2, 3, 5, 7)
BENDS = (90, 180)  # largest bend of a section of the targets [degrees]
TOLERANCES = (1e-4, 1e-6, 1e-8)  # [m] and [rad]
PAGE = Path("docs/ik-benchmark.md")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--targets", type=int, default=100_000, help="targets in all for every tolerance and start")
    parser.add_argument("--rivals", type=int, default=50, help="targets of every kind for each rival")
    parser.add_argument("--seed", type=int, default=2018)
    options = parser.parse_args()
    warm_up()
    n = options.targets // (len(SECTIONS) * len(BENDS))
    head = "solved | median [us] | p99 [us] | iterations | p99 |\n|---|---|---|---|---|---|---|---|---|"
    lines = [f"| sections | bends up to | start | tolerance | {head}"]
    rivals = [f"| sections | bends up to | solver | targets | {head}"]
    for n_sections in SECTIONS:
        for bend in BENDS:
            rng = np.random.default_rng([options.seed, n_sections, bend])
            sample = draw(prototype_arm(n_sections), math.radians(bend), n, rng)
            for from_random in (False, True):
                for tolerance in TOLERANCES:
                    score = score_solver(sample, tolerance, from_random)
                    start = "random" if from_random else "straight"
                    lines.append(f"| {n_sections} | {bend}° | {start} | {tolerance:g} | {score.cells()} |")
                    print(lines[-1], flush=True)
            for name, rival, count in (
                ("FABRIKc, 100 iterations", fabrikc(100), n),
                ("FABRIKc, 500 iterations", fabrikc(500), 20 * options.rivals),
                ("damped least squares", damped_least_squares, options.rivals),
                ("SciPy Levenberg-Marquardt", scipy_least_squares("lm"), options.rivals),
                ("SciPy trust region", scipy_least_squares("trf"), options.rivals),
            ):
                score = score_rival(sample, 1e-6, min(n, count), rival)
                rivals.append(f"| {n_sections} | {bend}° | {name} | {score.n} | {score.cells()} |")
                print(rivals[-1], flush=True)
    single, path, worst = score_helix()
    PAGE.write_text(page(options, n, lines, rivals, single, path, worst), encoding="utf-8")
    print(f"helix: {single.cells()} a call; {path.median:.1f} us a pose in one call; {worst:.1e} m; written: {PAGE}")


def page(
    options: argparse.Namespace, n: int, lines: list[str], rivals: list[str], single: Score, path: Score, worst: float
) -> str:
    """The page of results."""
    return f"""# Inverse kinematics benchmark

Made by `make bench-ik` (seed {options.seed}). Targets are tip positions and directions of random postures, {n} for
every row, {options.targets} for every start and tolerance; sections are the prototype's (Table 1: five joints,
b = 19.25 mm), turned by 30 degrees each, with bend limits of 180 degrees. A target counts as solved when the forward
kinematics says so. Times are of single Python calls, the making of the target and its checks included, on one core of a
shared two-core machine: read them as ratios within the page.

## The solver

{chr(10).join(lines)}

## Rivals, tolerance 1e-6, from the straight arm

The slow ones answer a subsample of the same targets. SciPy's Levenberg-Marquardt (MINPACK) takes no more unknowns than
equations, so from five sections on both SciPy rows are its trust region method. Of the rivals FABRIKc alone keeps bend
limits. Damped least squares crawls because the rows of a direction have lost a rank, which its constant damping feels.

{chr(10).join(rivals)}

## Warm start along the helix

The demo's helix at 120 Hz, tolerance 1e-9, each pose from the answer before it: {single.median:.1f} us median and
{single.p99:.1f} us p99 a Python call, {path.median:.1f} us a pose when the whole path is one call (`follow`);
{single.iterations:.0f} iterations median; all solved: {"yes" if min(single.solved, path.solved) == 1.0 else "no"};
largest distance of the tip to the helix {worst:.1e} m.
"""


if __name__ == "__main__":
    main()
