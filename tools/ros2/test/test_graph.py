"""Topics, nodes, parameters and services of real processes."""

import pytest
import yaml

pytestmark = pytest.mark.ros

NODE = """
import rclpy
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from std_srvs.srv import SetBool

rclpy.init()
node = rclpy.create_node("plant")
bounds = FloatingPointRange(from_value=0.0, to_value=5.0)
node.declare_parameter("gain", 1.5, ParameterDescriptor(description="of it", floating_point_range=[bounds]))
node.declare_parameter("names.all", ["a", "b"])


def answer(request, response):
    response.success, response.message = request.data, "done"
    return response


node.create_service(SetBool, "switch", answer)
print("ready", flush=True)
try:
    rclpy.spin(node)
except rclpy.executors.ExternalShutdownException:
    pass
except KeyboardInterrupt:
    pass
"""


def test_publish_and_echo(ros2) -> None:
    values = "{header: {frame_id: base, stamp: now}, name: [a, b], position: [1, 2.5]}"
    publisher = ros2.start("topic", "pub", "-r", "20", "/joints", "sensor_msgs/msg/JointState", values)
    publisher.wait_for("publishing #1")
    echoed = ros2("topic", "echo", "/joints", "--once", "--spin-time", "120").stdout
    assert echoed.endswith("---\n")
    message = yaml.safe_load(echoed.removesuffix("---\n"))
    assert message["name"] == ["a", "b"]
    assert message["position"] == [1.0, 2.5]
    assert message["header"]["frame_id"] == "base"
    assert message["header"]["stamp"]["sec"] > 1_000_000_000
    line = ros2("topic", "echo", "joints", "--once", "--csv", "--field", "position", "--spin-time", "120").stdout
    assert line == "1.0,2.5\n"
    assert ros2("topic", "type", "/joints", "--spin-time", "120").stdout == "sensor_msgs/msg/JointState\n"
    info = ros2("topic", "info", "/joints", "--spin-time", "120").stdout
    assert info == "Type: sensor_msgs/msg/JointState\nPublisher count: 1\nSubscription count: 0\n"
    assert "/joints [sensor_msgs/msg/JointState]\n" in ros2("topic", "list", "-t", "--spin-time", "120").stdout
    assert ros2("topic", "find", "sensor_msgs/msg/JointState", "--spin-time", "120").stdout == "/joints\n"
    assert "no 'nix' in" in ros2("topic", "echo", "/joints", "--field", "nix", "--spin-time", "120", code=1).stderr
    rate = ros2.start("topic", "hz", "/joints")
    rate.wait_for("average rate: ")
    assert rate.stop() == 2
    bandwidth = ros2.start("topic", "bw", "/joints", "--window", "5")
    bandwidth.wait_for("from 5 messages\n\tMessage size mean: ")
    assert bandwidth.stop() == 2
    assert publisher.stop() == 2
    assert "Traceback" not in publisher.stderr + rate.stderr


def test_one_message_waits_for_its_reader(ros2) -> None:
    reader = ros2.start("topic", "echo", "--once", "/remapped", "std_msgs/msg/String")
    ros2("topic", "pub", "-1", "/words", "std_msgs/String", "data: ü", "--ros-args", "-r", "/words:=/remapped")
    assert reader.exit_code() == 0
    assert reader.stdout == "data: ü\n---\n"


def test_what_is_not_there(ros2) -> None:
    short = ("--spin-time", "0.2")
    assert "does not appear to be published yet" in ros2("topic", "echo", "/nix", *short, code=1).stderr
    assert "Unknown topic '/nix'" in ros2("topic", "info", "/nix", *short, code=1).stderr
    assert "Node not found: '/nix'" in ros2("param", "get", "nix", "a", *short, code=1).stderr
    assert "no field 'dat'" in ros2("topic", "pub", "-1", "/x", "std_msgs/msg/String", "dat: 1", code=1).stderr
    assert "not installed" in ros2("topic", "pub", "-1", "/x", "std_msgs/msg/Nix", code=1).stderr
    assert "--ros-args" in ros2("node", "list", "--ros-args", "-r", "nonsense", code=1).stderr


def test_parameters_of_a_launched_node(ros2, program, tmp_path) -> None:
    program("plant", NODE)
    file = tmp_path / "test.launch.py"
    file.write_text("""
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([Node(package="demo", executable="plant", name="plant", namespace="lab", output="screen",
                                   parameters=[{"gain": 2.5}])])
""")
    launch = ros2.start("launch", file)
    launch.wait_for("[plant-1] ready")
    node, wait = "/lab/plant", ("--spin-time", "120")
    assert ros2("param", "get", node, "gain", *wait).stdout == "Double value is: 2.5\n"
    assert ros2("param", "set", node, "gain", "3.5", *wait).stdout == "Set parameter successful\n"
    assert ros2("param", "get", node, "gain", "--hide-type", *wait).stdout == "3.5\n"
    assert "Setting parameter failed" in ros2("param", "set", node, "gain", "7.0", *wait, code=1).stderr
    assert "not set" in ros2("param", "get", node, "nix", *wait, code=1).stderr
    assert "  gain\n  names.all\n" in ros2("param", "list", node, *wait).stdout
    dumped = yaml.safe_load(ros2("param", "dump", node, *wait).stdout)[node]["ros__parameters"]
    assert (dumped["gain"], dumped["names"]["all"]) == (3.5, ["a", "b"])
    described = ros2("param", "describe", node, "gain", *wait).stdout
    assert "Type: double\n  Description: of it\n  Constraints:\n    Min value: 0.0\n    Max value: 5.0\n" in described
    assert f"{node}\n" in ros2("node", "list", *wait).stdout
    assert "    /lab/switch: std_srvs/srv/SetBool\n" in ros2("node", "info", node, *wait).stdout
    assert ros2("service", "type", "/lab/switch", *wait).stdout == "std_srvs/srv/SetBool\n"
    assert "/lab/switch\n" in ros2("service", "find", "std_srvs/srv/SetBool", *wait).stdout
    assert ros2("service", "find", "std_srvs/srv/Trigger", *wait).stdout == ""
    called = ros2("service", "call", "/lab/switch", "std_srvs/srv/SetBool", "data: true").stdout
    assert "SetBool_Response(success=True, message='done')" in called
    assert launch.stop() == 0
    assert "[plant-1]: process has finished cleanly" in launch.stdout


MANAGED = """
import rclpy
from rclpy.lifecycle import LifecycleNode

rclpy.init()
node = LifecycleNode("managed")
print("ready", flush=True)
try:
    rclpy.spin(node)
except (rclpy.executors.ExternalShutdownException, KeyboardInterrupt):
    pass
"""


def test_a_managed_node_goes_through_its_states(ros2, program) -> None:
    program("managed", MANAGED)
    node = ros2.start("run", "demo", "managed")
    node.wait_for("ready")
    wait = ("--spin-time", "120")
    assert ros2("lifecycle", "nodes", *wait).stdout == "/managed\n"
    assert ros2("lifecycle", "get", "managed", *wait).stdout == "unconfigured [1]\n"
    assert "allows: configure [1]" in ros2("lifecycle", "set", "managed", "activate", *wait, code=1).stderr
    for transition, state in (("configure", "inactive [2]"), ("3", "active [3]")):
        assert ros2("lifecycle", "set", "managed", transition, *wait).stdout == "Transitioning successful\n"
        assert ros2("lifecycle", "get", *wait).stdout == f"/managed: {state}\n"
    assert "- deactivate [4]\n\tStart: active\n" in ros2("lifecycle", "list", "managed", *wait).stdout
    node.stop()
    assert "Node not found" in ros2("lifecycle", "get", "managed", "--spin-time", "0.2", code=1).stderr
