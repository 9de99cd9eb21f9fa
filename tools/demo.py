"""`make demo`: the thesis's helix (chapter 4.1) followed by real nodes, recorded, and judged.

Starts `ros2 launch trajectory_generator helix.launch.xml` with the recorder, shows how far it is, stops the launch when
the last cable state has come, and reports on the recording. Everything is left in out/demo.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import rclpy
from ament_index_python.packages import get_package_share_directory
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.node import Node
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from continuum.arm import load_arm
from continuum.cli import main as continuum
from continuum.errors import ContinuumError
from continuum.parameter_file import flattened, read_parameter_file
from continuum_manipulator.nodekit.qos import STREAM
from continuum_msgs.msg import CableStates
from trajectory_generator.from_parameters import trajectory_from_mapping

OUT = Path("out/demo")
START_TIMEOUT = 30.0  # until the first cable state [s]
STALL_TIMEOUT = 5.0  # between cable states [s]


class CableStateCounter(Node):
    """Counts what the tangler publishes, to show progress and to see the end."""

    def __init__(self) -> None:
        super().__init__("demo_progress")
        self.count = 0
        self.create_subscription(CableStates, "cable_states", self._on_message, STREAM, raw=True)

    def _on_message(self, _: bytes) -> None:
        self.count += 1


def main() -> int:
    arm_file = Path(get_package_share_directory("continuum_description")) / "config" / "three_sections.yaml"
    trajectory_file = Path(get_package_share_directory("trajectory_generator")) / "config" / "helix.yaml"
    parameters = flattened(read_parameter_file(trajectory_file))
    times = trajectory_from_mapping(parameters).times(parameters["rate"])
    arm = load_arm(arm_file)
    print(f"Helix of thesis 4.1, {times[-1]:.1f} s at {parameters['rate']:g} Hz, three sections of Table 1's modules")
    print(f"({1e3 * arm.length:.1f} mm long; the whole helix is within their reach). Results go to {OUT}/.")
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    finished = run_nodes(len(times))
    if not finished:
        print(f"The run ended early; what the nodes said is in {OUT}/nodes.log.", file=sys.stderr)
    report = [
        "report",
        str(OUT / "recording"),
        "--arm",
        str(arm_file),
        "--out",
        str(OUT),
        "--expected",
        str(len(times)),
    ]
    status = continuum(report)
    return status if finished else 1


def run_nodes(n_poses: int) -> bool:
    """Run the launch file until all poses have become cable states; True if they did."""
    command = ["ros2", "launch", "trajectory_generator", "helix.launch.xml", f"record:={OUT / 'recording'}"]
    with (OUT / "nodes.log").open("w", encoding="utf-8") as log:
        launch = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            return follow(launch, n_poses)
        except KeyboardInterrupt:
            return False
        finally:
            stop(launch)


def follow(launch: subprocess.Popen[bytes], n_poses: int) -> bool:
    """Show progress until ``n_poses`` cable states have come, or nothing comes any more."""
    rclpy.init()
    node = CableStateCounter()
    executor = EventsExecutor()
    executor.add_node(node)
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.completed}/{task.total} poses"),
        TimeRemainingColumn(),
    )
    try:
        with Progress(*columns) as progress:
            bar = progress.add_task("starting the nodes", total=n_poses)
            deadline, before = time.monotonic() + START_TIMEOUT, 0
            while node.count < n_poses and launch.poll() is None and time.monotonic() < deadline:
                executor.spin_once(timeout_sec=0.2)
                if node.count > before:
                    deadline, before = time.monotonic() + STALL_TIMEOUT, node.count
                    progress.update(bar, completed=node.count, description="following the helix")
        return node.count >= n_poses
    finally:
        rclpy.try_shutdown()


def stop(launch: subprocess.Popen[bytes]) -> None:
    """Interrupt the launch as Ctrl-C would, and wait until every node has ended."""
    if launch.poll() is None:
        os.killpg(launch.pid, signal.SIGINT)
    try:
        launch.wait(timeout=20.0)
    except subprocess.TimeoutExpired:
        os.killpg(launch.pid, signal.SIGKILL)
        launch.wait()


if __name__ == "__main__":
    try:
        sys.exit(main())
    except ContinuumError as error:
        sys.exit(f"demo: {error}")
