"""`make bench-ik`: the inverse kinematics solver against plain FABRIKc and SciPy, on reachable targets drawn by a seed.

Every figure is of one core. The solver answers all targets; slow rivals answer a stated subsample of the same ones.
Results go to docs/ik-benchmark.md.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from ament_index_python.packages import get_package_share_directory
from scipy.optimize import least_squares
from trajectory_generator.from_parameters import trajectory_from_mapping

from continuum.arm import Arm, Section, load_arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.ik_target import Target, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics
from continuum.parameter_file import flattened, read_parameter_file

SECTIONS = (1, 2, 3, 5, 7)
BENDS = (90, 180)  # largest bend of a section of the targets [degrees]
TOLERANCES = (1e-4, 1e-6, 1e-8)  # [m] and [rad]
PAGE = Path("docs/ik-benchmark.md")


@dataclass(frozen=True)
class Sample:
    """Targets that an arm can reach, because a posture of it made them; positions and directions of the tip."""

    arm: Arm
    targets: Targets
    starts: Array


@dataclass(frozen=True)
class Score:
    """What a solver did: part solved, time per target [us] and iterations, each median and 99th percentile."""

    solved: float
    n: int
    median: float
    p99: float
    iterations: float
    iterations_p99: float

    def cells(self) -> str:
        n_failed = round((1.0 - self.solved) * self.n)
        part = f"{100 * self.solved:.3f} %" + (f" ({n_failed} of {self.n})" if n_failed else "")
        return f"{part} | {self.median:.1f} | {self.p99:.1f} | {self.iterations:.0f} | {self.iterations_p99:.0f}"


def prototype_arm(n_sections: int) -> Arm:
    """Sections of five of the prototype's modules (Table 1), turned by 30 degrees each, as the demo's arm."""
    return Arm(
        tuple(Section(f"s{i}", 5, 0.01925, 0.032, twist=math.radians(30) if i else 0.0) for i in range(n_sections))
    )


def draw(arm: Arm, largest_bend: float, n: int, rng: np.random.Generator) -> Sample:
    """Draw ``n`` postures with bends up to ``largest_bend`` [rad], and as many random starts."""

    def postures(limit: float) -> Array:
        bend = rng.uniform(0.0, limit, (n, arm.n_sections))
        azimuth = rng.uniform(0.0, 2.0 * math.pi, (n, arm.n_sections))
        return np.stack([-bend * np.sin(azimuth), bend * np.cos(azimuth)], axis=-1)

    poses = arm_pose(postures(largest_bend), arm)
    return Sample(arm, Targets(poses[:, :3, 3], poses[:, :3, 2]), postures(math.pi))


def each_target(sample: Sample, n: int) -> Iterator[tuple[int, Target]]:
    for k in range(n):
        yield k, Target(sample.targets.positions[k], sample.targets.directions[k])


def score_solver(sample: Sample, tolerance: float, from_random: bool) -> Score:
    """Time the call that a program makes, target by target; the making of the target object is not counted."""
    solver = InverseKinematics(sample.arm, tolerance)
    n = len(sample.targets)
    times, iterations, solved = np.empty(n), np.empty(n), np.zeros(n, bool)
    for k, target in each_target(sample, n):
        start = sample.starts[k] if from_random else None
        began = time.perf_counter()
        result = solver.solve(target, start)
        times[k] = time.perf_counter() - began
        iterations[k], solved[k] = result.iterations, _arrived(sample, k, result.configuration, tolerance)
    return _score(times, iterations, solved)


def score_rival(sample: Sample, tolerance: float, n: int, rival: Callable[[Sample, Target, float], tuple[Array, int]]) -> Score:
    """Time a rival on the first ``n`` targets, from the straight arm."""
    times, iterations, solved = np.empty(n), np.empty(n), np.zeros(n, bool)
    for k, target in each_target(sample, n):
        began = time.perf_counter()
        configuration, iterations[k] = rival(sample, target, tolerance)
        times[k] = time.perf_counter() - began
        solved[k] = _arrived(sample, k, configuration, tolerance)
    return _score(times, iterations, solved)


def fabrikc_100(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
    result = solve_fabrikc(sample.arm, target.position, target.direction, None, tolerance, 100)
    return result.configuration, result.iterations


def fabrikc_500(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
    result = solve_fabrikc(sample.arm, target.position, target.direction, None, tolerance, 500)
    return result.configuration, result.iterations


def scipy_least_squares(method: str) -> Callable[[Sample, Target, float], tuple[Array, int]]:
    """SciPy's ``lm`` (MINPACK's Levenberg-Marquardt) or ``trf`` with the exact Jacobian, from a nearly straight arm."""

    def solve(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
        weight = 0.1 * sample.arm.length

        def error(x: Array) -> Array:
            pose = arm_pose(x.reshape(-1, 2), sample.arm)
            return np.concatenate([pose[:3, 3] - target.position, weight * (pose[:3, 2] - target.direction)])

        def jacobian(x: Array) -> Array:
            w = x.reshape(-1, 2)
            rows = arm_jacobian(w, sample.arm)
            return np.concatenate([rows[:3], weight * np.cross(rows[3:], arm_pose(w, sample.arm)[:3, 2], axisa=0).T])

        n = 2 * sample.arm.n_sections
        chosen = "trf" if n > 6 else method  # MINPACK wants no fewer equations than unknowns
        found = least_squares(error, np.full(n, 0.01), jacobian, method=chosen, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        return found.x.reshape(-1, 2), found.nfev

    return solve


def damped_least_squares(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
    """The textbook's J^T (J J^T + lambda^2)^-1 e with a constant lambda of 5 mm, up to 500 steps, in NumPy."""
    weight = 0.1 * sample.arm.length
    w = np.full((sample.arm.n_sections, 2), 0.01)
    for iteration in range(500):
        pose, rows = arm_pose(w, sample.arm), arm_jacobian(w, sample.arm)
        error = np.concatenate([target.position - pose[:3, 3], weight * (target.direction - pose[:3, 2])])
        if np.linalg.norm(error) <= 0.1 * tolerance:
            return w, iteration
        jacobian = np.concatenate([rows[:3], weight * np.cross(rows[3:], pose[:3, 2], axisa=0).T])
        step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 0.005**2 * np.eye(6), error)
        w = w + step.reshape(-1, 2)
    return w, 500


def score_helix() -> tuple[Score, Score, float]:
    """The demo's helix: the call for one pose started from the answer before, and the call for the whole path.

    Returns the two scores and the largest distance of the tip to the helix [m].
    """
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
        target = Target(position)
        began = time.perf_counter()
        result = solver.solve(target, w)
        times[k] = time.perf_counter() - began
        w, iterations[k], solved[k] = result.configuration, result.iterations, result.solved
    single = _score(times, iterations, solved)
    began = time.perf_counter()
    batch = solver.follow(Targets(positions), begin)
    each = np.full(len(positions), (time.perf_counter() - began) / len(positions))
    worst = np.max(np.linalg.norm(arm_pose(batch.configurations, arm)[:, :3, 3] - positions, axis=-1))
    return single, _score(each, batch.iterations.astype(float), batch.solved), float(worst)


def _arrived(sample: Sample, k: int, w: Array, tolerance: float) -> bool:
    """Judged by the library's forward kinematics, not by the solver's own word; a hundredth is left to rounding."""
    pose = arm_pose(w, sample.arm)
    distance = np.linalg.norm(pose[:3, 3] - sample.targets.positions[k])
    angle = np.linalg.norm(np.cross(pose[:3, 2], sample.targets.directions[k]))
    return bool(distance <= 1.01 * tolerance and angle <= 1.01 * tolerance and pose[:3, 2] @ sample.targets.directions[k] > 0)


def _score(times: Array, iterations: Array, solved: Array) -> Score:
    return Score(
        float(np.mean(solved)),
        len(solved),
        1e6 * float(np.median(times)),
        1e6 * float(np.percentile(times, 99)),
        float(np.median(iterations)),
        float(np.percentile(iterations, 99)),
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--targets", type=int, default=100_000, help="targets in all for every tolerance and start")
    parser.add_argument("--rivals", type=int, default=200, help="targets of every kind for each rival")
    parser.add_argument("--seed", type=int, default=2018)
    options = parser.parse_args()
    n = options.targets // (len(SECTIONS) * len(BENDS))
    head = "solved | median [us] | p99 [us] | iterations | p99 |\n|---|---|---|---|---|---|---|---|---|"
    lines = [f"| sections | bends up to | start | tolerance | {head}"]
    rivals = [f"| sections | bends up to | solver | targets | {head}"]
    for n_sections in SECTIONS:
        for bend in BENDS:
            rng = np.random.default_rng([options.seed, n_sections, bend])
            sample = draw(prototype_arm(n_sections), math.radians(bend), n, rng)
            InverseKinematics(sample.arm).solve(Target([0.0, 0.0, 0.1]))
            for from_random in (False, True):
                for tolerance in TOLERANCES:
                    score = score_solver(sample, tolerance, from_random)
                    start = "random" if from_random else "straight"
                    lines.append(f"| {n_sections} | {bend}° | {start} | {tolerance:g} | {score.cells()} |")
                    print(lines[-1], flush=True)
            for name, rival, count in (
                ("FABRIKc, 100 iterations", fabrikc_100, n),
                ("FABRIKc, 500 iterations", fabrikc_500, min(n, 10 * options.rivals)),
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

Made by `make bench-ik` (seed {options.seed}). Targets are tip positions and directions of random postures, {n} for every
row, {options.targets} for every start and tolerance; sections are the prototype's (Table 1: five joints, b = 19.25 mm),
turned by 30 degrees each, with bend limits of 180 degrees. A target counts as solved when the forward kinematics says so.
Times are of single Python calls on one core of a shared two-core machine: read them as ratios within the page.

## The solver

{chr(10).join(lines)}

## Rivals, tolerance 1e-6, from the straight arm

The slow ones answer a subsample of the same targets. SciPy's Levenberg-Marquardt (MINPACK) takes no more unknowns than
equations, so from five sections on both SciPy rows are its trust region method. None of the rivals keeps bend limits but
FABRIKc.

{chr(10).join(rivals)}

## Warm start along the helix

The demo's helix at 120 Hz, tolerance 1e-9, each pose from the answer before it: {single.median:.1f} us median and
{single.p99:.1f} us p99 a Python call, {path.median:.1f} us a pose when the whole path is one call (`follow`);
{single.iterations:.0f} iterations median; all solved: {"yes" if min(single.solved, path.solved) == 1.0 else "no"};
largest distance of the tip to the helix {worst:.1e} m.
"""


if __name__ == "__main__":
    main()
