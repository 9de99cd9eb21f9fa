"""The robot's two solvers as nodes: the demo's helix by `ros2 launch`, recorded, one after the other.

    python3 -m tools.bench_ik.launched

Overwrites a table of docs/inverse-kinematics.md. The time per answer is that between a pose and its answer in the
recording, so it holds the time of both messages on their way; 41 s for each solver.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from ament_index_python.packages import get_package_share_directory
from rosbags.highlevel import AnyReader

from continuum.arm import Arm, load_arm
from continuum.arrays import Array
from continuum.parameter_file import flattened, read_parameter_file
from continuum.recordings.arm_recording import read_arm_recording
from continuum.recordings.bag import Bag, stamp_ns
from continuum.recordings.kinematic_report import report_on
from tools.demo.domain import domain_for_demo
from tools.demo.nodes import run_nodes
from tools.markdown import replace_between, table
from tools.one_line import in_one_line
from trajectory_generator.from_parameters import trajectory_from_mapping

PAGE = Path("docs/inverse-kinematics.md")
BEGIN, END = "<!-- made by `python3 -m tools.bench_ik.launched` -->", "<!-- end of launched -->"
HEAD = ("solver", "poses", "reached", "missed", "messages lost", "time per answer, median [ms]", "p99 [ms]")


def main() -> None:
    arm_file, trajectory_file = (
        Path(get_package_share_directory(package)) / "config" / name
        for package, name in (("continuum_description", "three_sections.yaml"), ("trajectory_generator", "helix.yaml"))
    )
    parameters = flattened(read_parameter_file(trajectory_file))
    n_poses = len(trajectory_from_mapping(parameters).times(parameters["rate"]))
    rows = []
    for solver in ("newton", "fabrikc"):
        with tempfile.TemporaryDirectory() as folder, domain_for_demo() as domain:
            run_nodes(trajectory_file, arm_file, Path(folder), domain, n_poses, solver)
            rows.append((f"`{solver}`", *_figures(Path(folder) / "recording", load_arm(arm_file), n_poses)))
            print(rows[-1], flush=True)
    replace_between(PAGE, BEGIN, END, table(HEAD, rows))


def _figures(recording: Path, arm: Arm, n_poses: int) -> tuple[str, ...]:
    with Bag(recording) as bag:
        report = report_on(read_arm_recording(bag, arm), n_poses)
    took = 1e3 * _answer_times(recording)
    figures = (report.n_targets, report.n_solved, report.n_targets - report.n_solved, report.n_lost)
    return *map(str, figures), f"{np.median(took):.2f}", f"{np.percentile(took, 99):.2f}"


def _answer_times(recording: Path) -> Array:
    """From the arrival of each pose to that of its answer, (n_answers,) [s]."""
    arrivals = dict[str, dict[int, int]]()
    with AnyReader([recording]) as reader:
        for connection, arrival, raw in reader.messages():
            if connection.topic in ("/traj_pose", "/ik_status"):
                stamp = stamp_ns(reader.deserialize(raw, connection.msgtype))
                arrivals.setdefault(connection.topic, {})[stamp] = arrival
    asked, answered = arrivals["/traj_pose"], arrivals["/ik_status"]
    return np.array([answered[stamp] - asked[stamp] for stamp in asked.keys() & answered.keys()]) * 1e-9


if __name__ == "__main__":
    sys.exit(in_one_line(main))
