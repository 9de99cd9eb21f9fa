"""The node of forward kinematics over DDS: where the tip is, how it moves, and what is refused."""

import numpy as np
import pytest
from arm_messages import ARM, instant_of, joint_state, postures, stamp
from geometry_msgs.msg import PoseStamped, TwistStamped
from harness import ARM_FILE, NodeProcess, Probe, running
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import JointState

from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.discs import arm_disc_poses

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
    say, random = probe.speaker(JointState, "joint_states").publish, np.random.default_rng(4)
    bends, sent = [], []
    for section in ARM.sections:
        phi, thetas = random.uniform(-3, 3), random.uniform(-0.2, 0.2, section.n_joints)
        bends.append(allen_from_jones(np.float64(phi), thetas))
        message = JointState(name=[section.phi_joint, *section.theta_joints], position=[phi, *thetas])
        message.header.stamp = stamp(100)
        sent.append(message)
    w, _ = postures(1)
    probe.warm_up(lambda: say(joint_state(99, w[0])), poses)
    for message in sent:
        say(message)
    probe.wait_until(lambda: poses, "a pose")
    np.testing.assert_allclose(matrix(poses[0]), arm_disc_poses(bends, ARM)[-1][-1], atol=1e-12)
    probe.listen_until_quiet()
    assert not twists  # no velocities were sent


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
