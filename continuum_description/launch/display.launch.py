"""Show an arm in RViz, with sliders for its joints.

    ros2 launch continuum_description display.launch.py arm:=/path/published_sections.yaml

gui:=false omits the sliders, so that joint_states can have another source, as a recording; rviz:=false omits RViz.
Beside a launch that publishes the arm's description and frames, as arm.launch.py does: gui:=false frames:=false.
Required ROS packages: joint_state_publisher_gui for the sliders, rviz2 for RViz.
"""

import sys
from collections.abc import Mapping

from launch import LaunchDescription
from launch_ros.actions import Node

from continuum.arm import arm_block, load_arm
from continuum.dynamics.taken_defaults import taken_defaults, warnings
from continuum.parameter_file import read_parameter_file
from continuum_description.launching import argument, file_of, frames, is_true, launch_file, node, rviz, switch


def generate_launch_description() -> LaunchDescription:
    """Return the arguments and the nodes."""
    arm = "parameter file of the arm, or name of a file in continuum_description"
    arguments = [
        argument("arm", "three_sections.yaml", arm),
        switch("gui", "true", "sliders for the joints"),
        switch("frames", "true", "description and frames of the arm; false beside a launch that publishes them"),
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
    started = [frames(arm, clock)] if is_true(given["frames"]) else []
    if is_true(given["gui"]):
        started.append(node("joint_state_publisher_gui", "joint_state_publisher_gui"))
    if is_true(given["rviz"]):
        started.append(rviz(clock))
    return started
