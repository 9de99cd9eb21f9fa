"""Show an arm in RViz, with sliders for its joints.

    ros2 launch continuum_description display.launch.py arm:=/path/published_sections.yaml

gui:=false omits the sliders, so that joint_states can have another source (the robot node, a recording); rviz:=false
omits RViz. Required ROS packages: robot_state_publisher, joint_state_publisher_gui, rviz2.
"""

import sys
from collections.abc import Mapping

from launch import LaunchDescription
from launch_ros.actions import Node

from continuum.arm import arm_block, load_arm
from continuum.dynamics.taken_defaults import taken_defaults, warnings
from continuum.parameter_file import read_parameter_file
from continuum.urdf.robot import urdf_text
from continuum_description.launching import argument, file_of, is_true, launch_file, node, rviz, switch, text


def generate_launch_description() -> LaunchDescription:
    """Return the arguments and the nodes."""
    arm = "parameter file of the arm, or name of a file in continuum_description"
    arguments = [
        argument("arm", "three_sections.yaml", arm),
        switch("gui", "true", "sliders for the joints"),
        switch("rviz", "true", "RViz with the arm, its frames and markers"),
        switch("use_sim_time", "false", "take the time from /clock"),
    ]
    return launch_file(__file__, arguments, nodes)


def nodes(given: Mapping[str, str]) -> list[Node]:
    """Return all nodes, after warnings of masses that are taken from another arm.

    Raises:
        ContinuumError: the arm's file is invalid.
    """
    file = file_of(given["arm"], "continuum_description")
    arm = load_arm(file)
    for line in warnings(taken_defaults(arm_block(file, read_parameter_file(file)), arm)):
        print(line, file=sys.stderr)
    clock = {"use_sim_time": is_true(given["use_sim_time"])}
    description = {"robot_description": text(urdf_text(arm))}
    started = [node("robot_state_publisher", "robot_state_publisher", description, clock)]
    if is_true(given["gui"]):
        started.append(node("joint_state_publisher_gui", "joint_state_publisher_gui"))
    if is_true(given["rviz"]):
        started.append(rviz(clock))
    return started
