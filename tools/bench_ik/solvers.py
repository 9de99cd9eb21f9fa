"""The robot's two solvers on the same targets: Gauss-Newton with restarts, and the thesis's FABRIKc.

    python3 -m tools.bench_ik.solvers

Overwrites a table of docs/inverse-kinematics.md. Positions and directions are reached by three sections whose bends are
drawn up to a limit, each from the straight arm; then the demo's helix is followed as the node `robot` does.
"""

from __future__ import annotations

import math
import time
from functools import partial
from pathlib import Path

import numpy as np
from ament_index_python.packages import get_package_share_directory

from continuum.arm import load_arm
from continuum.kinematics.compiled.warm_up import warm_up
from continuum.kinematics.fabrikc_tracking import FabrikcTracker
from continuum.kinematics.tracking import Tracker
from continuum.parameter_file import flattened, read_parameter_file
from tools.bench_ik.rivals import fabrikc
from tools.bench_ik.sample import draw, prototype_arm
from tools.bench_ik.scores import Score, quietest, score_of, score_rival, score_solver
from tools.markdown import replace_between, table
from trajectory_generator.from_parameters import trajectory_from_mapping

PAGE = Path("docs/inverse-kinematics.md")
BEGIN, END = "<!-- made by `python3 -m tools.bench_ik.solvers` -->", "<!-- end -->"
TARGETS, TOLERANCE, RATE = 3000, 1e-6, 120.0


def main() -> None:
    warm_up()
    rows = list[tuple[str, ...]]()
    for bend in (90, 180):
        sample = draw(prototype_arm(3), math.radians(bend), TARGETS, np.random.default_rng([3, bend]))
        scores = {
            "newton": quietest(partial(score_solver, sample, TOLERANCE, from_random=False)),
            "fabrikc": quietest(partial(score_rival, sample, TOLERANCE, TARGETS, fabrikc(100))),
        }
        rows += [_row(f"{TARGETS}, bends up to {bend}°", name, score) for name, score in scores.items()]
    arm = load_arm(Path(get_package_share_directory("continuum_description")) / "config" / "three_sections.yaml")
    for name, tracker in (("newton", Tracker(arm)), ("fabrikc", FabrikcTracker(arm, tolerance=1e-9))):
        rows.append(_row("helix, followed at 120 Hz", name, _followed(tracker)))
    text = table(("targets", "solver", "reached", "median [us]", "p99 [us]", "iterations, median", "p99"), rows)
    print(text)
    replace_between(PAGE, BEGIN, END, text)


def _row(targets: str, name: str, score: Score) -> tuple[str, ...]:
    figures = (score.median, score.p99, score.iterations, score.iterations_p99)
    return targets, f"`{name}`", f"{100 * score.solved:.2f} %", *(f"{figure:.0f}" for figure in figures)


def _followed(tracker: Tracker) -> Score:
    """Of the demo's helix, poses with their velocities."""
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
    main()
