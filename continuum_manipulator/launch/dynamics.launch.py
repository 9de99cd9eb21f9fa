"""Launch a simulated arm, which receives cable_tension_cmd and publishes joint_states, cable_states and its frames.

    ros2 launch continuum_manipulator dynamics.launch.py
    ros2 launch continuum_manipulator dynamics.launch.py model:=found.yaml integrator:=esdirk initial_bend:=1.5708

rviz:=true shows the arm and its cables; it needs rviz2 of a ROS desktop installation.
"""

from collections.abc import Mapping

from launch import LaunchDescription
from launch_ros.actions import Node

from continuum.arm import arm_to_mapping
from continuum.viewer.model_arm import arm_of_model
from continuum_description.launching import (
    argument,
    frames,
    is_true,
    launch_file,
    node,
    number,
    rviz,
    switch,
    text,
)


def generate_launch_description() -> LaunchDescription:
    """Return the arguments and the nodes."""
    arguments = [
        argument("model", "lamecc_prototype.yaml", "model or arm file, or name of one in the library"),
        argument("section", "", "section of an arm file with several, or name of the section of a model file"),
        argument("integrator", "bdf", "bdf (the thesis's method) or esdirk (fast)", ["bdf", "esdirk"]),
        argument("rate", "120.0", "states per second"),
        argument("initial_bend", "0.0", "total bend at the start in rad"),
        switch("rviz", "false", "RViz with the arm"),
        switch("use_sim_time", "false", "take the time from /clock"),
    ]
    return launch_file(__file__, arguments, nodes)


def nodes(given: Mapping[str, str]) -> list[Node]:
    """Return all nodes.

    Raises:
        ContinuumError: the file of the model is invalid.
    """
    section = given["section"] or None
    arm = arm_of_model(given["model"], section, section)
    clock = {"use_sim_time": is_true(given["use_sim_time"])}
    parameters = {
        "model": text(given["model"]),
        "section": text(given["section"]),
        "integrator": given["integrator"],
        "rate": number(given, "rate"),
        "initial_bend": number(given, "initial_bend"),
    }
    started = [node("continuum_manipulator", "dynamics", parameters, clock), frames(arm, clock)]
    if is_true(given["rviz"]):
        started += [node("continuum_manipulator", "markers", {"arm": arm_to_mapping(arm)}, clock), rviz(clock)]
    return started
