"""Talk to one node: send joint states to `section`, and compare the cable lengths that it answers with the library's.

    python3 examples/ros_section_node.py [FOLDER]

Source install/setup.bash first. Starts the node, bends the section in steps, prints the lengths, and ends the node.
Logs go to FOLDER (default out/examples/ros_section_node).
"""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import rclpy
from ament_index_python.packages import get_package_share_directory
from sensor_msgs.msg import JointState

from continuum.arm import load_arm
from continuum.kinematics.cables import cable_lengths
from continuum.kinematics.configuration import allen_from_jones
from continuum_msgs.msg import CableStates

ARM = Path(get_package_share_directory("continuum_description")) / "config/prototype.yaml"
SECTION = load_arm(ARM).sections[0]
PHI = np.radians(30.0)  # azimuth towards which the section bends [rad]
NODE = ["ros2", "run", "continuum_manipulator", "section", "--ros-args", "-p", "section:=1", "--params-file", ARM]


def main(out: Path) -> None:
    """Start the node, ask it, and end it in any case."""
    out.mkdir(parents=True, exist_ok=True)
    os.environ["ROS_LOG_DIR"] = str(out.resolve())
    rclpy.init()
    node, answers = rclpy.create_node("example"), []
    node.create_subscription(CableStates, "section_cable_states", answers.append, 10)
    publisher = node.create_publisher(JointState, "joint_states", 10)
    with (out / "section.log").open("w") as log:
        section = subprocess.Popen(NODE, stdout=log, stderr=log, start_new_session=True)
    try:
        for theta in np.radians([0.0, 30.0, 60.0, 90.0]):  # total bend [rad]
            bends = [theta / SECTION.n_joints] * SECTION.n_joints  # of each joint [rad]
            joints = JointState(name=[SECTION.phi_joint, *SECTION.theta_joints], position=[PHI, *bends])
            joints.header.stamp = node.get_clock().now().to_msg()
            while (not answers or answers[-1].header != joints.header) and section.poll() is None:
                publisher.publish(joints)  # again, until the node listens
                rclpy.spin_once(node, timeout_sec=0.2)
            lengths = np.array(answers[-1].position)  # l(phi, theta), (4,) [m]
            residual = abs(lengths - cable_lengths(allen_from_jones(PHI, theta), SECTION)).max()
            print(f"{np.degrees(theta):.0f} degrees: {np.round(1e3 * lengths, 2)} mm, residual {residual:.0e} m")
    finally:
        if section.poll() is None:
            os.killpg(section.pid, signal.SIGINT)  # as Ctrl-C does
        section.wait(timeout=20)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/ros_section_node"))
