"""Launch the nodes of an arm with any number of sections; optionally a trajectory, a recording and RViz.

    ros2 launch trajectory_generator arm.launch.py arm:=/path/my_arm.yaml
    ros2 launch trajectory_generator arm.launch.py trajectory:=helix.yaml record:=out/recording
    ros2 launch trajectory_generator arm.launch.py arm:=prototype.yaml mode:=cables rviz:=true

A trajectory starts when every node runs, and with record:=FOLDER when the recorder is ready too. If a node dies or the
recorder cannot start, the launch ends with a nonzero exit code. rviz:=true needs rviz2 of a ROS desktop installation.
"""

from collections.abc import Mapping
from pathlib import Path

from launch import LaunchDescription
from launch_ros.actions import Node

from continuum.arm import load_arm
from continuum_description.launching import (
    argument,
    file_of,
    frames,
    is_true,
    launch_file,
    node,
    rviz,
    switch,
    text,
)

REMAPS = {
    "inverse_kinematics": {"robot": {}, "section": {}, "cable_tangler": {}},
    "cables": {
        "robot": {"joint_states": "joint_commands"},
        "section": {"joint_states": "joint_commands", "section_joint_states": "joint_states"},
        "cable_tangler": {"cable_states": "cable_commands"},
    },
}
"""Topics by mode and executable. In the mode cables, the joints follow from the commanded cable lengths, and not
directly from the inverse kinematics."""


def generate_launch_description() -> LaunchDescription:
    """Return the arguments, and a function for the nodes, which depend on the arm's file."""
    arguments = [
        argument("arm", "three_sections.yaml", "parameter file of the arm, or name of a file in continuum_description"),
        argument(
            "mode", "inverse_kinematics",
            "input of the joints: poses of the tip, or the cable lengths that are commanded for them", list(REMAPS),
        ),
        argument(
            "trajectory", "", "parameter file of a trajectory, or name of a file in trajectory_generator; empty: none"
        ),
        argument("record", "", "folder for a rosbag2 recording of every topic; empty: none"),
        argument("target", "position", "part of a pose that the tip follows", ["position", "position_direction"]),
        argument(
            "solver", "newton", "inverse kinematics: Gauss-Newton with restarts, or the thesis's FABRIKc",
            ["newton", "fabrikc"],
        ),
        switch("tip", "false", "pose and twist of the tip, also to be recorded"),
        switch("markers", "true", "markers of cables and curvature"),
        switch("rviz", "false", "RViz with the arm"),
        switch("use_sim_time", "false", "take the time from /clock"),
    ]  # fmt: skip
    return launch_file(__file__, arguments, nodes)


def nodes(given: Mapping[str, str]) -> list[Node]:
    """Return all nodes.

    Raises:
        ContinuumError: the arm's file is invalid.
    """
    arm_file = file_of(given["arm"], "continuum_description")
    arm = load_arm(arm_file)
    numbers = range(1, arm.n_sections + 1)
    clock = {"use_sim_time": is_true(given["use_sim_time"])}

    def of_arm(executable: str, values: dict[str, object] | None = None, name: str = "") -> Node:
        remaps = list(REMAPS[given["mode"]].get(executable, {}).items())
        parameters = (arm_file, values or {}, clock)
        return node("continuum_manipulator", executable, *parameters, name=name, remappings=remaps)

    started = [of_arm("section", {"section": number}, f"section_{number}") for number in numbers]
    started += [of_arm("robot", {"target": given["target"], "solver": given["solver"]})]
    started += [of_arm("cable_tangler"), frames(arm, {"publish_tip": is_true(given["tip"])}, clock)]
    needed = [*(f"section_{number}" for number in numbers), "robot", "cable_tangler", "forward_kinematics"]
    if is_true(given["markers"]):
        started += [of_arm("markers")]
    if given["record"]:
        folder = text(str(Path(given["record"]).expanduser().absolute()))
        started += [node("continuum_manipulator", "recorder", {"output": folder}, clock)]
        needed += ["recorder"]
    if given["trajectory"]:
        file = file_of(given["trajectory"], "trajectory_generator")
        listeners = 2 if given["record"] else 1
        start = {"wait_for_nodes": needed, "subscribers": listeners, "settle_time": 1.0, "wait_timeout": 3600.0}
        started += [node("trajectory_generator", "trajectory_publisher", file, start, clock)]
    if is_true(given["rviz"]):
        started += [rviz(clock)]
    return started
