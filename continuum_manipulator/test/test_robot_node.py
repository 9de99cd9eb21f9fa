"""The robot node over DDS: poses, poses with twists, twists alone; out of reach; bad targets."""

import math

import numpy as np
import pytest
from arm_messages import ARM, NAMES, instant_of, pose, postures, twist
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistStamped
from harness import ARM_FILE, NodeProcess, Probe, running
from sensor_msgs.msg import JointState

from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum_manipulator.section_joints import read_joints
from continuum_msgs.msg import IkStatus

pytestmark = pytest.mark.ros

PLACE = arm_pose(postures(1, seed=6)[0][0] * 0.7, ARM)[:3, 3]


def configuration(message: JointState) -> tuple[np.ndarray, np.ndarray | None]:
    index = {name: k for k, name in enumerate(message.name)}
    states = [read_joints(index, message.position, message.velocity, section) for section in ARM.sections]
    rate = np.stack([state.rate for state in states]) if message.velocity else None
    return np.stack([state.w for state in states]), rate


def tip(message: JointState) -> np.ndarray:
    return arm_pose(configuration(message)[0], ARM)[:3, 3]


class Bench:
    def __init__(self, probe: Probe) -> None:
        self.probe = probe
        self.joints = probe.hear(JointState, "joint_states")
        self.status = probe.hear(IkStatus, "ik_status")

    def answers(self, n: int) -> list[JointState]:
        self.probe.wait_until(
            lambda: len(self.joints) >= n and len(self.status) >= n, lambda: f"{n} answers, not {len(self.joints)}"
        )
        self.probe.settle()
        joints, status = list(self.joints), list(self.status)
        assert [message.header.stamp for message in joints] == [message.header.stamp for message in status]
        return joints

    def clear(self) -> None:
        self.joints.clear()
        self.status.clear()


@pytest.fixture
def bench(domain):
    node = NodeProcess("continuum_manipulator", "robot", domain, files=(ARM_FILE,))
    with running(node), Probe(domain) as probe:
        yield Bench(probe)


def test_poses_alone_are_answered_at_once(bench):
    probe = bench.probe
    say = probe.speaker(PoseStamped, "traj_pose").publish
    probe.warm_up(lambda: say(pose(0, PLACE)), bench.joints, bench.status)
    far = PLACE / np.linalg.norm(PLACE) * (ARM.length + 0.1)
    say(pose(1, PLACE))
    say(pose(2, far))
    say(pose(3, PLACE, frame=""))
    joints = bench.answers(3)
    assert [instant_of(message) for message in joints] == [1, 2, 3]
    assert list(joints[0].name) == NAMES
    for message in (joints[0], joints[2]):
        np.testing.assert_allclose(tip(message), PLACE, atol=1e-6)
        assert not message.velocity
    solved, unreachable, again = bench.status
    assert (solved.status, again.status) == (IkStatus.SOLVED, IkStatus.SOLVED)
    assert unreachable.status in (IkStatus.UNREACHABLE, IkStatus.LIMIT_REACHED)
    assert unreachable.distance == pytest.approx(np.linalg.norm(tip(joints[1]) - far), abs=1e-9)
    assert 0.1 <= unreachable.distance < 0.11
    probe.wait_until(lambda: probe.report("robot").get("level") == "WARN", lambda: probe.report("robot"))

    bench.clear()
    no_rotation = pose(4, PLACE)
    no_rotation.pose.orientation.w = 0.0
    no_stamp = pose(4, PLACE)
    no_stamp.header.stamp = Time()
    for bad in (
        no_stamp,
        no_rotation,
        pose(5, [math.nan, 0, 0.3]),
        pose(6, [0, math.inf, 0]),
        pose(7, PLACE, frame="world"),
    ):
        say(bad)
    say(pose(8, [1e300, 0.0, -1e300]))
    say(pose(9, PLACE))
    probe.wait_until(
        lambda: any(instant_of(message) == 9 for message in bench.joints), "an answer after all the bad ones"
    )
    assert {instant_of(message) for message in bench.joints} <= {8, 9}
    for cause, count in {"no stamp": 1, "no rotation": 1, "not finite": 2, "wrong frame": 1}.items():
        probe.wait_until(lambda c=cause, n=count: probe.count("robot", f"dropped: {c}") == n, f"{count} {cause}")


def test_pose_and_twist_of_one_stamp_are_answered_together(bench):
    probe = bench.probe
    say_pose = probe.speaker(PoseStamped, "traj_pose").publish
    say_twist = probe.speaker(TwistStamped, "traj_twist").publish
    velocity = np.array([0.02, -0.05, 0.01])

    def send_both():
        say_pose(pose(0, PLACE))
        say_twist(twist(0, velocity))
        say_pose(pose(500, PLACE))
        say_twist(twist(500, velocity))

    probe.warm_up(send_both, bench.joints, bench.status)
    path = {i: PLACE + 0.01 * (i - 1000) * velocity for i in range(1000, 1010)}
    for i in path:
        say_twist(twist(i, velocity))
    for i, place in path.items():
        say_pose(pose(i, place))
    say_pose(pose(1010, PLACE))
    *joints, alone = bench.answers(11)
    assert [instant_of(message) for message in joints] == list(path)
    assert instant_of(alone) == 1010
    assert not alone.velocity
    for message in joints:
        w, rate = configuration(message)
        np.testing.assert_allclose(tip(message), path[instant_of(message)], atol=1e-6)
        np.testing.assert_allclose((arm_jacobian(w, ARM) @ rate.ravel())[:3], velocity, atol=1e-6)
    key = "poses answered without their twist"
    probe.wait_until(lambda: probe.count("robot", key) >= 1, lambda: probe.report("robot"))


def test_twists_alone_are_integrated(bench):
    probe = bench.probe
    say = probe.speaker(TwistStamped, "traj_twist").publish
    probe.warm_up(lambda: say(twist(0, [0, 0, 0])), bench.joints, bench.status)
    for i in range(10, 110):
        say(twist(i, [0.03, 0.01, -0.05]))
    middle, end = bench.answers(100)[49::50]  # by the middle it has left the straight posture, which cannot shorten
    np.testing.assert_allclose(tip(end) - tip(middle), np.array([0.03, 0.01, -0.05]) * 0.5, atol=2e-5)
    bench.clear()
    say(twist(1000, [0.03, 0.01, -0.05]))
    (after_gap,) = bench.answers(1)
    np.testing.assert_allclose(tip(after_gap), tip(end), atol=1e-12)


def test_direction_is_followed_on_request(domain):
    parameters = {"target": "position_direction"}
    node = NodeProcess("continuum_manipulator", "robot", domain, files=(ARM_FILE,), parameters=parameters)
    with running(node), Probe(domain) as probe:
        bench = Bench(probe)
        say = probe.speaker(PoseStamped, "traj_pose").publish
        goal = pose(1, [0.05, 0.0, 0.45])
        angle = 0.3
        goal.pose.orientation.x, goal.pose.orientation.w = math.sin(angle / 2), math.cos(angle / 2)
        probe.warm_up(lambda: say(pose(0, PLACE)), bench.joints, bench.status)
        say(goal)
        (answer,) = bench.answers(1)
        assert bench.status[0].status == IkStatus.SOLVED
        reached = arm_pose(configuration(answer)[0], ARM)
        np.testing.assert_allclose(reached[:3, 3], [0.05, 0.0, 0.45], atol=1e-6)
        np.testing.assert_allclose(reached[:3, 2], [0.0, -math.sin(angle), math.cos(angle)], atol=1e-6)


def test_fabrikc_answers_as_the_algorithm_by_itself_and_says_what_it_misses(domain):
    near, far = 0.9 * PLACE, np.array([0.0, 0.0, 2 * ARM.length])
    settings = {"tolerance": 1e-7, "max_iterations": 30}
    first = solve_fabrikc(ARM, PLACE, **settings)
    expected = solve_fabrikc(ARM, near, start=first.configuration, **settings)
    parameters = {"solver": "fabrikc", **settings}
    node = NodeProcess("continuum_manipulator", "robot", domain, files=(ARM_FILE,), parameters=parameters)
    with running(node), Probe(domain) as probe:
        bench = Bench(probe)
        say = probe.speaker(PoseStamped, "traj_pose").publish
        probe.warm_up(lambda: say(pose(0, PLACE)), bench.joints, bench.status)
        say(pose(1, near))
        say(pose(2, far))
        reached, missed = bench.answers(2)
        np.testing.assert_allclose(configuration(reached)[0], expected.configuration, atol=1e-9)
        assert [status.status for status in bench.status] == [IkStatus.SOLVED, IkStatus.NO_CONVERGENCE]
        assert [status.iterations for status in bench.status] == [expected.iterations, 30]
        np.testing.assert_allclose(bench.status[1].distance, np.linalg.norm(tip(missed) - far), rtol=1e-6)
