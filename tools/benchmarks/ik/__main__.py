"""`make bench-ik`: the inverse kinematics solver compared with FABRIKc and SciPy, on random reachable targets.

All figures are for one core. The solver answers all targets; slow rivals answer a stated subsample. The record of a
complete run is written; that of a run with changed options is only printed.
"""

from __future__ import annotations

import argparse
import math
import sys
from functools import partial
from itertools import product

import numpy as np

from continuum.kinematics.compiled.warm_up import warm_up
from tools.benchmarks.ik.figures import FABRIKC, RivalRow, Row, record_of
from tools.benchmarks.ik.rivals import damped_least_squares, fabrikc, scipy_least_squares
from tools.benchmarks.ik.sample import draw, prototype_arm
from tools.benchmarks.ik.scores import quietest, score_helix, score_rival, score_solver
from tools.benchmarks.report import as_text, publish
from tools.one_line import in_one_line

SECTIONS = (1, 2, 3, 5, 7)
BENDS = (90, 180)  # largest bend of a section of the targets [degrees]
TOLERANCES = (1e-4, 1e-6, 1e-8)  # [m] and [rad]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--targets", type=int, default=100_000, help="targets in all for every tolerance and start")
    parser.add_argument("--rivals", type=int, default=1000, help="targets of every kind for each rival that is slow")
    parser.add_argument("--slowest", type=int, default=100, help="the same for damped least squares")
    parser.add_argument("--seed", type=int, default=2018)
    options = parser.parse_args()
    warm_up()
    n = options.targets // (len(SECTIONS) * len(BENDS))
    rows, rivals = [], []
    for n_sections, bend in product(SECTIONS, BENDS):
        rng = np.random.default_rng([options.seed, n_sections, bend])
        sample = draw(prototype_arm(n_sections), math.radians(bend), n, rng)
        for from_random, tolerance in product((False, True), TOLERANCES):
            score = quietest(partial(score_solver, sample, tolerance, from_random))
            rows.append(Row(n_sections, bend, "random" if from_random else "straight", tolerance, score))
            print(*rows[-1].cells, sep=" | ", flush=True)
        for name, rival, count in (
            (FABRIKC, fabrikc(100), n),
            ("FABRIKc, 500 iterations", fabrikc(500), options.rivals),
            ("damped least squares", damped_least_squares, options.slowest),
            ("SciPy Levenberg-Marquardt", scipy_least_squares("lm"), options.rivals),
            ("SciPy trust region", scipy_least_squares("trf"), options.rivals // 3),
        ):
            if name.endswith("Marquardt") and n_sections > 3:
                continue  # MINPACK does not accept more unknowns than equations
            score = score_rival(sample, 1e-6, min(n, count), rival)
            rivals.append(RivalRow(n_sections, bend, name, score))
            print(*rivals[-1].cells, sep=" | ", flush=True)
    helix = min((score_helix() for _ in range(3)), key=lambda one: one.single.median)
    record = record_of(rows, rivals, helix, vars(options))
    print(as_text(record))
    if all(getattr(options, name) == parser.get_default(name) for name in vars(options)):
        publish(record)


if __name__ == "__main__":
    sys.exit(in_one_line(main))
