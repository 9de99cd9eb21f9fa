"""Launch the nodes of an arm with any number of sections; optionally a trajectory, a recording and RViz.

    ros2 launch trajectory_generator arm.launch.py arm:=/path/my_arm.yaml
    ros2 launch trajectory_generator arm.launch.py trajectory:=helix.yaml record:=out/recording
    ros2 launch trajectory_generator arm.launch.py arm:=prototype.yaml mode:=cables rviz:=true

A trajectory starts when every node runs, and with record:=FOLDER when the recorder is ready too. If a node dies or the
recorder cannot start, the launch ends with a nonzero exit code. rviz:=true needs robot_state_publisher and rviz2 of a
ROS desktop installation.
"""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.events.process import ProcessExited
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from continuum.arm import load_arm

BOOLEANS = ("true", "false", "True", "False")

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

MAY_END = ("trajectory_publisher", "rviz2")
"""Processes that may end normally without ending the launch."""


def generate_launch_description() -> LaunchDescription:
    """Return the arguments, and a function for the nodes, which depend on the arm's file."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "arm",
                default_value="three_sections.yaml",
                description="parameter file of the arm, or name of a file in continuum_description",
            ),
            DeclareLaunchArgument(
                "mode",
                default_value="inverse_kinematics",
                choices=list(REMAPS),
                description="input of the joints: poses of the tip, or the cable lengths that are commanded for them",
            ),
            DeclareLaunchArgument(
                "trajectory",
                default_value="",
                description="parameter file of a trajectory, or name of a file in trajectory_generator; empty: none",
            ),
            DeclareLaunchArgument(
                "record",
                default_value="",
                description="folder for a rosbag2 recording of every topic; empty: none",
            ),
            DeclareLaunchArgument(
                "target",
                default_value="position",
                choices=["position", "position_direction"],
                description="part of a pose that the tip follows",
            ),
            DeclareLaunchArgument(
                "solver",
                default_value="newton",
                choices=["newton", "fabrikc"],
                description="inverse kinematics of the robot: Gauss-Newton with restarts, or the thesis's FABRIKc",
            ),
            DeclareLaunchArgument(
                "markers", default_value="true", choices=list(BOOLEANS), description="markers of cables and curvature"
            ),
            DeclareLaunchArgument(
                "tip",
                default_value="false",
                choices=list(BOOLEANS),
                description="pose and twist of the tip from the joints and, without RViz, the frames of all discs",
            ),
            DeclareLaunchArgument(
                "rviz", default_value="false", choices=list(BOOLEANS), description="RViz with the arm"
            ),
            DeclareLaunchArgument(
                "use_sim_time", default_value="false", choices=list(BOOLEANS), description="take the time from /clock"
            ),
            RegisterEventHandler(OnProcessExit(on_exit=miss)),
            OpaqueFunction(function=nodes),
        ]
    )


def miss(event: ProcessExited, context: LaunchContext) -> None:
    """End the launch when a required process ends."""
    name = event.process_name.rpartition("-")[0]
    if not context.is_shutdown and (event.returncode != 0 or name not in MAY_END):
        raise RuntimeError(f"{name} ended with exit code {event.returncode}; the launch requires it and ends")


def nodes(context: LaunchContext) -> list[Node | IncludeLaunchDescription]:
    """Return all nodes.

    Raises:
        ContinuumError: the arm's file is invalid.
    """
    given = context.launch_configurations
    arm_file = file_of(given["arm"], "continuum_description")
    numbers = range(1, load_arm(arm_file).n_sections + 1)
    remaps = REMAPS[given["mode"]]
    clock = {"use_sim_time": is_true(given["use_sim_time"])}

    def node(executable: str, name: str, *parameters: str | dict, package: str = "continuum_manipulator") -> Node:
        return Node(
            package=package,
            executable=executable,
            name=name,
            exec_name=name,
            output="screen",
            parameters=[*parameters, clock],
            remappings=list(remaps.get(executable, {}).items()),
        )

    started = [node("section", f"section_{number}", arm_file, {"section": number}) for number in numbers]
    started += [node("robot", "robot", arm_file, {"target": given["target"], "solver": given["solver"]})]
    started += [node("cable_tangler", "cable_tangler", arm_file)]
    needed = [*(f"section_{number}" for number in numbers), "robot", "cable_tangler"]
    if is_true(given["markers"]):
        started += [node("markers", "markers", arm_file)]
    if is_true(given["tip"]):
        frames = {"publish_tf": not is_true(given["rviz"])}  # with RViz, robot_state_publisher publishes these frames
        started += [node("forward_kinematics", "forward_kinematics", arm_file, frames)]
        needed += ["forward_kinematics"]
    if given["record"]:
        folder = ParameterValue(str(Path(given["record"]).expanduser().absolute()), value_type=str)
        started += [node("recorder", "recorder", {"output": folder})]
        needed += ["recorder"]
    if given["trajectory"]:
        file = file_of(given["trajectory"], "trajectory_generator")
        listeners = 2 if given["record"] else 1
        start = {"wait_for_nodes": needed, "subscribers": listeners, "settle_time": 1.0, "wait_timeout": 3600.0}
        started += [node("trajectory_publisher", "trajectory_publisher", file, start, package="trajectory_generator")]
    if is_true(given["rviz"]):
        display = Path(get_package_share_directory("continuum_description")) / "launch" / "display.launch.xml"
        arguments = {"arm": arm_file, "gui": "false", "rviz": "true", "use_sim_time": given["use_sim_time"]}
        started += [
            IncludeLaunchDescription(AnyLaunchDescriptionSource(str(display)), launch_arguments=arguments.items())
        ]
    return started


def file_of(text: str, package: str) -> str:
    """Return the absolute path of a file, or of the file with this name in the package.

    Raises:
        RuntimeError: neither exists.
    """
    shipped = Path(get_package_share_directory(package)) / "config"
    for path in (Path(text).expanduser().absolute(), shipped / text):
        if path.is_file():
            return str(path)
    names = ", ".join(sorted(path.name for path in shipped.glob("*.yaml")))
    raise RuntimeError(f"{text!r} is not a file; {package} has: {names}")


def is_true(text: str) -> bool:
    """Return one of `BOOLEANS` as a truth value."""
    return text.lower() == "true"
