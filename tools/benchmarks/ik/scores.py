"""Score of a solver on a sample of targets: fraction solved, time, iterations."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from ament_index_python.packages import get_package_share_directory

from continuum.arm import load_arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.ik_target import Target, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics
from continuum.parameter_file import flattened, read_parameter_file
from tools.benchmarks.ik.rivals import Rival
from tools.benchmarks.ik.sample import Sample, arrived, each_target
from trajectory_generator.from_parameters import trajectory_from_mapping

_FEWEST_FOR_P99 = 300  # targets
SCORE_HEAD = ("solved", "median [us]", "p99 [us]", "iterations", "iterations, p99")


@dataclass(frozen=True)
class Score:
    """Score of a solver: fraction solved, processor time per target [us] and iterations, with 99th percentiles."""

    solved: float
    n: int
    median: float
    p99: float
    iterations: float
    iterations_p99: float

    @property
    def cells(self) -> tuple[str, ...]:
        """Return the cells under `SCORE_HEAD`; 99th percentiles only with enough targets."""
        n_failed, enough = round((1.0 - self.solved) * self.n), self.n >= _FEWEST_FOR_P99
        part = f"{100 * self.solved:.3f} %" if enough else f"{100 * self.solved:.1f} %"
        failed = f" ({n_failed} of {self.n} not)" if n_failed or not enough else ""
        p99, iterations_p99 = (f"{self.p99:.1f}", f"{self.iterations_p99:.0f}") if enough else ("", "")
        return part + failed, f"{self.median:.1f}", p99, f"{self.iterations:.0f}", iterations_p99


@dataclass(frozen=True)
class Helix:
    """The demo's helix.

    Attributes:
        single: score with one call per pose, starting from the previous solution.
        path: score with one call for the whole path; times are means over all poses.
        farthest: largest distance of the tip to the helix [m].
    """

    single: Score
    path: Score
    farthest: float


def quietest(measure: Callable[[], Score]) -> Score:
    """Return the fastest of three measurements, to exclude other load; solved counts targets solved in all of them."""
    scores = [measure() for _ in range(3)]
    best = min(scores, key=lambda score: score.median)
    return replace(best, solved=min(score.solved for score in scores))


def score_solver(sample: Sample, tolerance: float, from_random: bool) -> Score:
    """Time each target as in a program: construction of the checked target, and the call of the solver."""
    solver = InverseKinematics(sample.arm, tolerance)

    def answer(k: int) -> Answer:
        target = Target(sample.targets.positions[k], sample.targets.directions[k])
        result = solver.solve(target, sample.starts[k] if from_random else None)
        return result.configuration, result.iterations, result.solved

    return _score_calls(answer, sample, tolerance, len(sample.targets))


def score_rival(sample: Sample, tolerance: float, n: int, rival: Rival) -> Score:
    """Time a rival on the first ``n`` targets, from the straight arm."""
    targets = [target for _, target in each_target(sample, n)]

    def answer(k: int) -> Answer:
        return *rival(sample, targets[k], tolerance), True

    return _score_calls(answer, sample, tolerance, n)


type Answer = tuple[Array, int, bool]
"""Configuration, iterations, and whether the solver reports success."""


def _score_calls(answer: Callable[[int], Answer], sample: Sample, tolerance: float, n: int) -> Score:
    """Time consecutive calls, as in a program, and check the solutions afterwards."""
    times, answers = np.empty(n), []
    for k in range(n):
        began = time.thread_time()
        given = answer(k)
        times[k] = time.thread_time() - began
        answers.append(given)
    solved = [says_so and arrived(sample, k, w, tolerance) for k, (w, _, says_so) in enumerate(answers)]
    return score_of(times, np.array([iterations for _, iterations, _ in answers], dtype=float), np.array(solved))


def score_helix() -> Helix:
    """Follow the helix in both ways."""
    share = get_package_share_directory
    arm = load_arm(Path(share("continuum_description")) / "config" / "three_sections.yaml")
    parameters = flattened(read_parameter_file(Path(share("trajectory_generator")) / "config" / "helix.yaml"))
    trajectory = trajectory_from_mapping(parameters)
    positions = trajectory.sample(trajectory.times(120.0)).position
    begin = InverseKinematics(arm, 1e-9, "least_bending").solve(Target(positions[0])).configuration
    solver = InverseKinematics(arm, 1e-9)
    times, iterations, solved = np.empty(len(positions)), np.empty(len(positions)), np.zeros(len(positions), bool)
    w = begin
    for k, position in enumerate(positions):
        began = time.thread_time()
        result = solver.solve(Target(position), w)
        times[k] = time.thread_time() - began
        w, iterations[k], solved[k] = result.configuration, result.iterations, result.solved
    single = score_of(times, iterations, solved)
    began = time.thread_time()
    batch = solver.follow(Targets(positions), begin)
    each = np.full(len(positions), (time.thread_time() - began) / len(positions))
    worst = np.max(np.linalg.norm(arm_pose(batch.configurations, arm)[:, :3, 3] - positions, axis=-1))
    return Helix(single, score_of(each, batch.iterations.astype(float), batch.solved), float(worst))


def score_of(times: Array, iterations: Array, solved: Array) -> Score:
    """Return the score from processor times [s], iterations and whether targets were reached, (n,) each."""
    return Score(
        float(np.mean(solved)),
        len(solved),
        1e6 * float(np.median(times)),
        1e6 * float(np.percentile(times, 99)),
        float(np.median(iterations)),
        float(np.percentile(iterations, 99)),
    )
