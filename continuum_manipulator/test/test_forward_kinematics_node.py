"""The node of forward kinematics over DDS: where the tip is, how it moves, and what is refused."""

import numpy as np
import pytest
from arm_messages import ARM, instant_of, joint_state, postures, stamp
from geometry_msgs.msg import PoseStamped, TwistStamped
from harness import ARM_FILE, NodeProcess, Probe, running
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.discs import arm_disc_poses
from continuum_manipulator.nodekit.qos import TRANSFORMS

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module")
def probe(domain):
    node = NodeProcess("continuum_manipulator", "forward_kinematics", domain, files=(ARM_FILE,))
    with running(node), Probe(domain) as probe:
        yield probe


def matrix(message: PoseStamped) -> np.ndarray:
    place, turn = message.pose.position, message.pose.orientation
    found = np.eye(4)
    found[:3, :3] = Rotation.from_quat([turn.x, turn.y, turn.z, turn.w]).as_matrix()
    found[:3, 3] = place.x, place.y, place.z
    return found


def velocity(message: TwistStamped) -> np.ndarray:
    linear, angular = message.twist.linear, message.twist.angular
    return np.array([linear.x, linear.y, linear.z, angular.x, angular.y, angular.z])


def uneven_joints(instant: int, seed: int) -> tuple[list[np.ndarray], list[JointState]]:
    """Bends of every joint, and a message for each section."""
    random, bends, sent = np.random.default_rng(seed), [], []
    for section in ARM.sections:
        phi, thetas = random.uniform(-3, 3), random.uniform(-0.2, 0.2, section.n_joints)
        bends.append(allen_from_jones(np.float64(phi), thetas))
        message = JointState(name=[section.phi_joint, *section.theta_joints], position=[phi, *thetas])
        message.header.stamp = stamp(instant)
        sent.append(message)
    return bends, sent


def test_the_tip_is_where_and_moves_as_the_joints_say(probe):
    poses, twists = probe.hear(PoseStamped, "tip_pose"), probe.hear(TwistStamped, "tip_twist")
    say = probe.speaker(JointState, "joint_states").publish
    w, rate = postures(20)
    probe.warm_up(lambda: say(joint_state(0, w[0], rate[0])), poses, twists)
    for k in range(20):
        say(joint_state(k + 1, w[k], rate[k]))
    probe.wait_until(lambda: len(poses) == len(twists) == 20, lambda: f"20 answers, not {len(poses)}, {len(twists)}")
    for k, (pose, twist) in enumerate(zip(poses, twists, strict=True)):
        assert instant_of(pose) == instant_of(twist) == k + 1
        assert pose.header.frame_id == twist.header.frame_id == "base_link"
        np.testing.assert_allclose(matrix(pose), arm_pose(w[k], ARM), atol=1e-12)
        np.testing.assert_allclose(velocity(twist), arm_jacobian(w[k], ARM) @ rate[k].reshape(-1), atol=1e-9)


def test_joints_need_not_bend_alike_nor_come_in_one_message(probe):
    poses, twists = probe.hear(PoseStamped, "tip_pose"), probe.hear(TwistStamped, "tip_twist")
    say = probe.speaker(JointState, "joint_states").publish
    bends, sent = uneven_joints(100, seed=4)
    w, _ = postures(1)
    probe.warm_up(lambda: say(joint_state(99, w[0])), poses)
    for message in sent:
        say(message)
    probe.wait_until(lambda: poses, "a pose")
    np.testing.assert_allclose(matrix(poses[0]), arm_disc_poses(bends, ARM)[-1][-1], atol=1e-12)
    probe.listen_until_quiet()
    assert not twists  # no velocities were sent


def frames_of(message: TFMessage) -> dict[str, np.ndarray]:
    found = {}
    for one in message.transforms:
        place, turn = one.transform.translation, one.transform.rotation
        found[one.child_frame_id] = np.eye(4)
        found[one.child_frame_id][:3, :3] = Rotation.from_quat([turn.x, turn.y, turn.z, turn.w]).as_matrix()
        found[one.child_frame_id][:3, 3] = place.x, place.y, place.z
    return found


def expected_frames(bends: list[np.ndarray], prefix: str = "") -> dict[str, np.ndarray]:
    names = [f"{prefix}{frame}" for section in ARM.sections for frame in section.disc_frames]
    return dict(zip(names, np.concatenate(arm_disc_poses(bends, ARM)), strict=True))


def check_frames(message: TFMessage, instant: int, bends: list[np.ndarray], prefix: str = "") -> None:
    found, expected = frames_of(message), expected_frames(bends, prefix)
    assert found.keys() == expected.keys()
    assert len(message.transforms) == len(found)
    assert {(one.header.frame_id, instant_of(one)) for one in message.transforms} == {(f"{prefix}base_link", instant)}
    for name, pose in expected.items():
        np.testing.assert_allclose(found[name], pose, atol=1e-12)


def test_frames_of_discs_are_on_tf(probe):
    frames = probe.hear(TFMessage, "/tf", TRANSFORMS)
    say = probe.speaker(JointState, "joint_states").publish
    w, _ = postures(1)
    probe.warm_up(lambda: say(joint_state(199, w[0])), frames)
    sent = {instant: uneven_joints(instant, seed=instant) for instant in range(200, 210)}
    for _, messages in sent.values():
        for message in messages:
            say(message)
    probe.wait_until(lambda: len(frames) == len(sent), lambda: f"{len(sent)} messages, not {len(frames)}")
    for (instant, (bends, _)), message in zip(sent.items(), frames, strict=True):
        check_frames(message, instant, bends)


def test_frames_may_have_a_prefix_or_stay_out(probe, domain):
    """As with a second arm, or where robot_state_publisher runs."""
    nodes = [
        NodeProcess(
            "continuum_manipulator", "forward_kinematics", domain, name=name, files=(ARM_FILE,), parameters=parameters,
            arguments=("--ros-args", "-r", f"/tf:=/{name}/tf", "-r", f"tip_pose:={name}/tip_pose",
                       "-r", "tip_twist:=elsewhere", "--"),
        )
        for name, parameters in {"second": {"frame_prefix": "second/"}, "quiet": {"publish_tf": "false"}}.items()
    ]  # fmt: skip
    with running(*nodes):
        frames = probe.hear(TFMessage, "/second/tf", TRANSFORMS)
        poses = probe.hear(PoseStamped, "quiet/tip_pose")
        say = probe.speaker(JointState, "joint_states", listeners=3).publish
        w, _ = postures(1)
        probe.warm_up(lambda: say(joint_state(219, w[0])), frames, poses)
        bends, messages = uneven_joints(220, seed=1)
        for message in messages:
            say(message)
        probe.wait_until(lambda: frames and poses, "frames, and a pose of the other node")
        check_frames(frames[0], 220, bends, "second/")
        assert "/quiet/tf" not in dict(probe.node.get_topic_names_and_types())


def test_bad_joints_are_dropped_and_counted_and_the_node_lives(probe):
    poses = probe.hear(PoseStamped, "tip_pose")
    say = probe.speaker(JointState, "joint_states").publish
    w, _ = postures(1)
    probe.warm_up(lambda: say(joint_state(300, w[0])), poses)
    broken = joint_state(301, w[0])
    broken.position[1] = float("nan")
    stranger = JointState(name=["elbow"], position=[0.0])
    stranger.header.stamp = stamp(302)
    for message in (broken, stranger, joint_state(303, w[0])):
        say(message)
    probe.wait_until(lambda: poses, "a pose")
    probe.listen_until_quiet()
    assert [instant_of(one) for one in poses] == [303]
