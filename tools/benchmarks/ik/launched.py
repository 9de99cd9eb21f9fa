"""The robot's two solvers as nodes: recordings of the demo's helix by `ros2 launch`, in sequence.

    python3 -m tools.benchmarks.ik.launched

Writes its record and overwrites a table of docs/inverse-kinematics.md. The time per answer is the time between a pose
and its answer in the recording, and includes the transmission of both messages. Each solver takes 41 s.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
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
from tools.benchmarks.record import Figure, Record, Table
from tools.benchmarks.report import as_text, publish
from tools.demo.domain import domain_for_demo
from tools.demo.nodes import run_nodes
from tools.one_line import in_one_line
from trajectory_generator.from_parameters import trajectory_from_mapping

COMMAND = "python3 -m tools.benchmarks.ik.launched"
HEAD = ("solver", "poses", "reached", "missed", "messages lost", "time per answer, median [ms]", "p99 [ms]")


@dataclass(frozen=True)
class Followed:
    """Numbers of poses, reached poses and lost messages, and times per answer: median and 99th percentile [ms]."""

    poses: int
    reached: int
    lost: int
    median: float
    p99: float

    @property
    def missed(self) -> int:
        return self.poses - self.reached

    @property
    def cells(self) -> tuple[str, ...]:
        counts = self.poses, self.reached, self.missed, self.lost
        return *map(str, counts), f"{self.median:.2f}", f"{self.p99:.2f}"


def main() -> None:
    arm_file, trajectory_file = (
        Path(get_package_share_directory(package)) / "config" / name
        for package, name in (("continuum_description", "three_sections.yaml"), ("trajectory_generator", "helix.yaml"))
    )
    parameters = flattened(read_parameter_file(trajectory_file))
    n_poses = len(trajectory_from_mapping(parameters).times(parameters["rate"]))
    found = dict[str, Followed]()
    for solver in ("newton", "fabrikc"):
        with tempfile.TemporaryDirectory() as folder, domain_for_demo() as domain:
            run_nodes(trajectory_file, arm_file, Path(folder), domain, n_poses, solver)
            found[solver] = _followed(Path(folder) / "recording", load_arm(arm_file), n_poses)
    record = record_of(found["newton"], found["fabrikc"])
    print(as_text(record))
    publish(record)


def record_of(newton: Followed, fabrikc: Followed) -> Record:
    """Return the record of both solvers in one run."""
    what, rival = "helix by `ros2 launch`, solver `newton`", "`fabrikc`"
    figures = (
        Figure(f"{what}: poses missed", newton.missed, rival=rival, rival_value=fabrikc.missed),
        Figure(f"{what}: time per answer, median", newton.median, "ms", rival=rival, rival_value=fabrikc.median),
    )
    rows = [(f"`{name}`", *one.cells) for name, one in (("newton", newton), ("fabrikc", fabrikc))]
    return Record("ik-launched", COMMAND, figures, {"solvers": Table.of(HEAD, rows)})


def _followed(recording: Path, arm: Arm, n_poses: int) -> Followed:
    with Bag(recording) as bag:
        report = report_on(read_arm_recording(bag, arm), n_poses)
    took = 1e3 * _answer_times(recording)
    times = float(np.median(took)), float(np.percentile(took, 99))
    return Followed(report.n_targets, report.n_solved, report.n_lost, *times)


def _answer_times(recording: Path) -> Array:
    """Return the times from the arrival of each pose to that of its answer, (n_answers,) [s]."""
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
