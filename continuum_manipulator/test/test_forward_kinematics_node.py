"""The node of forward kinematics over DDS: where tip and links are, how the tip moves, and what is refused."""

import numpy as np
import pytest
from arm_messages import ARM, instant_of, joint_state, postures, stamp
from frame_tree import FrameTree
from geometry_msgs.msg import PoseStamped, TwistStamped
from harness import ARM_FILE, NodeProcess, Probe, running
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.discs import arm_disc_poses
from continuum.urdf.robot import urdf_text
from continuum_manipulator.nodekit.qos import LATCHED, TRANSFORMS

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module")
def probe(domain):
    often = {"publish_frequency": 1000.0}
    node = NodeProcess("continuum_manipulator", "forward_kinematics", domain, files=(ARM_FILE,), parameters=often)
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
    probe.settle()
    assert not twists  # no velocities were sent


class Frames:
    """What a node says of its frames, below a topic's prefix."""

    def __init__(self, probe: Probe, prefix: str = "") -> None:
        self.moving = probe.hear(TFMessage, f"{prefix}/tf", TRANSFORMS)
        self.fixed = probe.hear(TFMessage, f"{prefix}/tf_static", LATCHED)
        self.descriptions = probe.hear(String, f"{prefix}/robot_description", LATCHED)

    def instants(self) -> list[int]:
        return [instant_of(one) for message in self.moving for one in message.transforms[:1]]

    def discs(self, instant: int, prefix: str = "") -> np.ndarray:
        """Poses (n, 4, 4) of the discs in base_link."""
        messages = [*self.fixed, *(one for one in self.moving if instant_of(one.transforms[0]) == instant)]
        tree = FrameTree(one for message in messages for one in message.transforms)
        assert tree.roots() == {f"{prefix}base_link"}
        return np.array([tree.pose(f"{prefix}{frame}") for section in ARM.sections for frame in section.disc_frames])


def test_frames_of_discs_are_on_tf_and_the_description_is_there_for_who_comes_late(probe):
    frames = Frames(probe)
    say = probe.speaker(JointState, "joint_states").publish
    w, _ = postures(1)
    probe.warm_up(lambda: say(joint_state(199, w[0])), frames.moving)
    probe.wait_until(lambda: frames.descriptions and frames.fixed, "what was said before")
    assert [message.data for message in frames.descriptions] == [urdf_text(ARM)]
    sent = {instant: uneven_joints(instant, seed=instant) for instant in range(200, 210)}
    for _, messages in sent.values():
        for message in messages:
            say(message)
    wanted = [instant for instant in sent for _ in ARM.sections]
    probe.wait_until(lambda: len(frames.moving) >= len(wanted), lambda: f"{frames.instants()}")
    assert frames.instants() == wanted
    for instant, (bends, _) in sent.items():
        np.testing.assert_allclose(frames.discs(instant), np.concatenate(arm_disc_poses(bends, ARM)), atol=1e-12)


def test_frames_may_have_a_prefix_and_a_frequency_or_stay_out(probe, domain):
    """As with a second arm, or where robot_state_publisher runs."""
    parameters = {
        "second": {"frame_prefix": "second/", "publish_frequency": 20.0, "publish_tip": False},
        "quiet": {"publish_tf": "false"},
    }
    topics = ("tf", "tf_static", "robot_description", "tip_pose", "tip_twist")
    remaps = {name: [word for topic in topics for word in ("-r", f"/{topic}:=/{name}/{topic}")] for name in parameters}
    nodes = [
        NodeProcess(
            "continuum_manipulator", "forward_kinematics", domain, name=name, files=(ARM_FILE,), parameters=given,
            arguments=("--ros-args", *remaps[name], "--"),
        )
        for name, given in parameters.items()
    ]  # fmt: skip
    with running(*nodes):
        frames, poses = Frames(probe, "/second"), probe.hear(PoseStamped, "quiet/tip_pose")
        say = probe.speaker(JointState, "joint_states", listeners=3).publish
        w, _ = postures(1)
        probe.warm_up(lambda: say(joint_state(400, w[0])), frames.moving, poses)
        bends, _ = uneven_joints(500, seed=1)
        for instant in range(500, 511):
            for message in uneven_joints(instant, seed=1)[1]:
                say(message)
        probe.wait_until(lambda: len(poses) == 11, lambda: f"11 poses of the other node, not {len(poses)}")
        probe.wait_until(lambda: 510 in frames.instants(), lambda: f"{frames.instants()}")
        assert sorted({*frames.instants()}) == [500, 505, 510]  # stamps are 10 ms apart
        found = frames.discs(505, "second/")
        np.testing.assert_allclose(found, np.concatenate(arm_disc_poses(bends, ARM)), atol=1e-12)
        said = dict(probe.node.get_topic_names_and_types())
        assert said.keys().isdisjoint({"/quiet/tf", "/quiet/tf_static", "/quiet/robot_description"})
        assert said.keys().isdisjoint({"/second/tip_pose", "/second/tip_twist"})


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
    probe.wait_until(lambda: 303 in map(instant_of, poses), "a pose")
    assert [instant_of(one) for one in poses] == [303]
