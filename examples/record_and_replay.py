"""Record the nodes of an arm while its tip follows an arc, read the recording, and play its cable states again.

    python3 examples/record_and_replay.py [FOLDER]

Source install/setup.bash first. Recording and logs go to FOLDER (default out/examples/record_and_replay).
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import rclpy
import yaml
from ament_index_python.packages import get_package_share_directory

from continuum.arm import load_arm
from continuum.recordings.arm_recording import read_arm_recording
from continuum.recordings.bag import Bag
from continuum.recordings.kinematic_report import report_on
from continuum_msgs.msg import CableStates

ARM = Path(get_package_share_directory("continuum_description")) / "config/three_sections.yaml"  # default of arm:=
ARC = {"start": [0.15, 0.0, 0.4], "center": [0.0, 0.0, 0.4], "toward": [0.0, 0.15, 0.4], "angle": 1.0}  # [m], [rad]
MOTION = {"path": "circle", "circle": ARC, "max_speed": 0.2, "max_acceleration": 0.4, "rest_time": 0.2}  # SI


def main(out: Path) -> None:
    """Record until the trajectory is over, read and judge the recording, play it and listen."""
    out = out.resolve() / time.strftime("run_%Y-%m-%d_%H-%M-%S")
    out.mkdir(parents=True)
    os.environ["ROS_LOG_DIR"] = str(out)
    trajectory, bag = out / "arc.yaml", out / "bag"
    trajectory.write_text(yaml.safe_dump({"/**": {"ros__parameters": MOTION | {"exit_at_end": True}}}))
    launch = ["ros2", "launch", "trajectory_generator", "arm.launch.py", f"trajectory:={trajectory}", f"record:={bag}"]
    nodes = subprocess.Popen(launch, stdout=subprocess.PIPE, text=True, start_new_session=True)
    try:
        any("process has finished cleanly" in line for line in nodes.stdout)  # the trajectory's, at its end
    finally:
        nodes.send_signal(signal.SIGINT)  # as Ctrl-C does: every node ends, the recorder finishes its file
        nodes.communicate(timeout=60)

    with Bag(bag) as opened:
        report = report_on(recorded := read_arm_recording(opened, load_arm(ARM)))
    print(f"{report.n_solved} of {report.n_targets} poses reached, {report.n_lost} messages lost")

    rclpy.init()
    node, received = rclpy.create_node("example"), []
    node.create_subscription(CableStates, "cable_states", lambda message: received.append(message.position), 1000)
    subprocess.run(["ros2", "bag", "play", bag, "--topics", "/cable_states", "--delay", "1", "--rate", "4"], check=True)
    for _ in range(1000):  # the subscription's queue holds so many
        rclpy.spin_once(node, timeout_sec=0.0)
    print(f"{len(received)} cable states played; as recorded: {np.array_equal(received, recorded.lengths.values)}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/record_and_replay"))
