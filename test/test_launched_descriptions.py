"""What every launch says of its arm: description and frames that other readers take; and no node dies in silence."""

import io
import signal
from collections import defaultdict

import numpy as np
import pytest
import yourdfpy
from arm_launch import ARM, launched
from frame_tree import FrameTree
from geometry_msgs.msg import PoseStamped
from harness import Probe
from rcl_interfaces.srv import GetParameters
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from continuum.dynamics.model_file import load_model
from continuum.inertial.calibration_values import Calibration, save_calibration
from continuum_hw_imu.emulator.link_motion import gravity
from continuum_manipulator.nodekit.qos import LATCHED, TRANSFORMS
from continuum_manipulator.nodekit.stamps import nanoseconds

PLANAR = ["section_1_phi", *(f"section_1_theta_{k}" for k in range(1, 6)), "section_1_phi_back"]


def target(probe: Probe) -> None:
    """Let the robot find a posture."""
    message = PoseStamped()
    message.header.frame_id, message.header.stamp = "base_link", probe.node.get_clock().now().to_msg()
    message.pose.position.x, message.pose.position.z, message.pose.orientation.w = 0.15, 0.3, 1.0
    probe.speaker(PoseStamped, "traj_pose").publish(message)


def angles(probe: Probe) -> None:
    """Say angles in the place of a bench without a calibration, or of sliders."""
    message = JointState(name=PLANAR, position=[0.0, 0.1, 0.2, 0.3, -0.1, -0.2, 0.0])
    message.header.stamp = probe.node.get_clock().now().to_msg()
    probe.speaker(JointState, "joint_states").publish(message)


LAUNCHES = {
    "arm": (ARM, target, "robot", 0),
    "dynamics": (("continuum_manipulator", "dynamics.launch.py", "initial_bend:=1.0"), lambda _: None, "dynamics", 0),
    "bench": (
        ("continuum_hw_imu", "bench.launch.py", "emulator_link:=port", "emulator_control:=control"),
        angles, "bench_bridge", 5,
    ),
    "display": (
        ("continuum_description", "display.launch.py", "arm:=planar_prototype.yaml", "gui:=false", "rviz:=false"),
        angles, "forward_kinematics", 0,
    ),
}  # fmt: skip
"""The launch, what makes it publish joints, a node that it requires, and the number of its sensors."""


@pytest.mark.ros
@pytest.mark.parametrize("name", LAUNCHES)
def test_a_reader_of_others_finds_every_link_where_the_joints_say(name, domain, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words, move, required, n_sensors = LAUNCHES[name]
    with Probe(domain) as probe, launched(domain, tmp_path, file=words) as launch:
        descriptions = probe.hear(String, "/robot_description", LATCHED)
        fixed, moving = probe.hear(TFMessage, "/tf_static", LATCHED), probe.hear(TFMessage, "/tf", TRANSFORMS)
        joints = probe.hear(JointState, "/joint_states")
        probe.wait_until(lambda: descriptions and fixed, lambda: launch.said)
        while not moving:
            move(probe)
            probe.spin(0.5)
        stamp = nanoseconds(moving[0].transforms[0].header.stamp)
        probe.wait_until(lambda: stamp in map(stamp_of, joints), lambda: launch.said)
        (state,) = (message for message in joints if stamp_of(message) == stamp)
        (text,) = (message.data for message in descriptions)
        assert parameter(probe, "/forward_kinematics", "robot_description") == text
        for topic in ("/tf", "/tf_static", "/robot_description"):
            assert probe.node.count_publishers(topic) == 1
        check_tree(text, FrameTree([*fixed[0].transforms, *moving[0].transforms]), state, n_sensors)
        launch.kill_node(required, signal.SIGKILL)
        assert launch.exit_code() == 1
        assert f"{required} ended with exit code -9; the launch requires it" in launch.said


def stamp_of(message) -> int:
    return nanoseconds(message.header.stamp)


def check_tree(text: str, tree: FrameTree, state: JointState, n_sensors: int) -> None:
    """One tree of all links, each where yourdfpy has it; joints whose angles are known mimic none."""
    robot = yourdfpy.URDF.load(io.BytesIO(text.encode()), load_meshes=False)
    known = dict(zip(state.name, state.position, strict=True))
    followed = {joint.name: known[joint.mimic.joint] for joint in robot.robot.joints if joint.mimic is not None}
    for joint in robot.robot.joints:
        joint.mimic = None
    reader = yourdfpy.URDF(robot.robot, load_meshes=False)
    turned_back = {name: -angle for name, angle in followed.items() if name not in known}
    reader.update_cfg(known | turned_back)
    assert tree.roots() == {"base_link"}
    assert tree.frames == {link.name for link in reader.robot.links}
    for frame in tree.frames:
        np.testing.assert_allclose(tree.pose(frame), reader.get_transform(frame, "base_link"), atol=1e-7)
    discs = {frame for frame in tree.frames if "_disc_" in frame or frame.endswith("_tip")}
    sensors = [frame for frame in tree.frames if "_imu_" in frame]
    assert len(discs) % 5 == 0 < len(discs)
    assert len(sensors) == n_sensors
    assert np.ptp([tree.pose(disc)[0, 3] for disc in discs]) > 0.01  # it is bent


def parameter(probe: Probe, node: str, name: str) -> str:
    client = probe.node.create_client(GetParameters, f"{node}/get_parameters")
    probe.wait_until(client.service_is_ready, "the service")
    answer = client.call_async(GetParameters.Request(names=[name]))
    probe.wait_until(answer.done, "the answer")
    return answer.result().values[0].string_value


@pytest.mark.ros
def test_sensors_are_turned_as_their_calibration_says(domain, tmp_path, monkeypatch):
    """The frames' y axis is that of the turns, and gravity is where the sensor reads it."""
    monkeypatch.chdir(tmp_path)
    model, random = load_model("lamecc_prototype.yaml"), np.random.default_rng(2)
    turns = np.linalg.qr(random.normal(size=(5, 3, 3)))[0]
    turns *= np.linalg.det(turns)[:, None, None]
    axis, zero = turns.transpose(0, 2, 1) @ [0.0, 1.0, 0.0], turns.transpose(0, 2, 1) @ -gravity(model)
    save_calibration(Calibration(np.zeros((5, 3)), axis, zero, ("made up",) * 5), tmp_path / "sensors.yaml")
    words = (*LAUNCHES["bench"][0], "calibration:=sensors.yaml")
    with Probe(domain) as probe, launched(domain, tmp_path, file=words) as launch:
        fixed = probe.hear(TFMessage, "/tf_static", LATCHED)
        probe.wait_until(lambda: fixed, lambda: launch.said)
    found = defaultdict(dict)
    for one in fixed[0].transforms:
        found[one.header.frame_id][one.child_frame_id] = FrameTree([one]).pose(one.child_frame_id)
    discs = [*(f"section_1_disc_{k}" for k in range(1, 5)), "section_1_tip"]
    for k, (disc, turn) in enumerate(zip(discs, turns, strict=True), start=1):
        np.testing.assert_allclose(found[disc][f"section_1_imu_{k}"][:3, :3], turn, atol=1e-9)


@pytest.mark.parametrize("hang_angle", [0.0, 0.7, -2.0])
def test_mountings_are_those_of_the_emulated_arm(hang_angle):
    model = load_model("lamecc_prototype.yaml").with_values({"hang_angle": hang_angle})
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    calibration = Calibration(
        np.zeros((1, 3)), (turn.T @ [0.0, 1.0, 0.0])[None], (turn.T @ -gravity(model))[None], ("made up",)
    )
    np.testing.assert_allclose(calibration.mountings(hang_angle), [turn], atol=1e-12)
