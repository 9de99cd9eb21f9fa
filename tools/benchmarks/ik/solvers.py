"""The robot's two solvers on the same targets: Gauss-Newton with restarts, and the thesis's FABRIKc.

    python3 -m tools.benchmarks.ik.solvers

Writes its record and overwrites a table of docs/inverse-kinematics.md. Three sections with random bends up to a limit
give positions and directions, each solved from the straight arm; then the demo's helix is followed as by the node
`robot`.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Mapping
from functools import partial
from pathlib import Path

import numpy as np
from ament_index_python.packages import get_package_share_directory

from continuum.arm import load_arm
from continuum.kinematics.compiled.warm_up import warm_up
from continuum.kinematics.fabrikc_tracking import FabrikcTracker
from continuum.kinematics.tracking import Tracker
from continuum.parameter_file import flattened, read_parameter_file
from tools.benchmarks.ik.rivals import fabrikc
from tools.benchmarks.ik.sample import draw, prototype_arm
from tools.benchmarks.ik.scores import Score, quietest, score_of, score_rival, score_solver
from tools.benchmarks.record import Figure, Record, Table
from tools.benchmarks.report import as_text, publish
from tools.one_line import in_one_line
from trajectory_generator.from_parameters import trajectory_from_mapping

COMMAND = "python3 -m tools.benchmarks.ik.solvers"
TARGETS, TOLERANCE, RATE = 3000, 1e-6, 120.0
HEAD = ("targets", "solver", "reached", "median [us]", "p99 [us]", "iterations, median", "p99")


def main() -> None:
    warm_up()
    scores = dict[str, dict[str, Score]]()
    for bend in (90, 180):
        sample = draw(prototype_arm(3), math.radians(bend), TARGETS, np.random.default_rng([3, bend]))
        scores[f"{TARGETS}, bends up to {bend}°"] = {
            "newton": quietest(partial(score_solver, sample, TOLERANCE, from_random=False)),
            "fabrikc": quietest(partial(score_rival, sample, TOLERANCE, TARGETS, fabrikc(100))),
        }
    arm = load_arm(Path(get_package_share_directory("continuum_description")) / "config" / "three_sections.yaml")
    trackers = {"newton": Tracker(arm), "fabrikc": FabrikcTracker(arm, tolerance=1e-9)}
    scores["helix, followed at 120 Hz"] = {name: _followed(tracker) for name, tracker in trackers.items()}
    record = record_of(scores)
    print(as_text(record))
    publish(record)


def record_of(scores: Mapping[str, Mapping[str, Score]]) -> Record:
    """Scores of both solvers by targets."""
    figures = []
    for targets, by_solver in scores.items():
        newton, published = by_solver["newton"], by_solver["fabrikc"]
        what, rival = f"solver `newton`, targets: {targets}", "`fabrikc`"
        figures += [
            Figure(f"{what}; reached", 100 * newton.solved, "%", rival=rival, rival_value=100 * published.solved),
            Figure(f"{what}; time, median", newton.median, "us", rival=rival, rival_value=published.median),
        ]
    rows = [_row(targets, name, score) for targets, each in scores.items() for name, score in each.items()]
    return Record("ik-solvers", COMMAND, tuple(figures), {"solvers": Table.of(HEAD, rows)})


def _row(targets: str, name: str, score: Score) -> tuple[str, ...]:
    figures = (score.median, score.p99, score.iterations, score.iterations_p99)
    return targets, f"`{name}`", f"{100 * score.solved:.2f} %", *(f"{figure:.0f}" for figure in figures)


def _followed(tracker: Tracker) -> Score:
    """Return the score on the demo's helix, poses with their velocities."""
    share = Path(get_package_share_directory("trajectory_generator"))
    trajectory = trajectory_from_mapping(flattened(read_parameter_file(share / "config" / "helix.yaml")))
    path = trajectory.sample(trajectory.times(RATE))
    took, found = [], []
    for k, (position, velocity) in enumerate(zip(path.position, path.linear_velocity, strict=True)):
        began = time.thread_time()
        found.append(tracker.pose(position, velocity=velocity, dt=1 / RATE if k else None).result)
        took.append(time.thread_time() - began)
    return score_of(
        np.array(took), np.array([one.iterations for one in found]), np.array([one.solved for one in found])
    )


if __name__ == "__main__":
    sys.exit(in_one_line(main))
