"""The estimator over DDS: what encoders measure becomes configurations, joints and, remapped, a pose of the tip."""

import numpy as np
import pytest
from arm_messages import ARM, NAMES, cables, instant_of, postures
from geometry_msgs.msg import PoseStamped, TwistStamped
from harness import ARM_FILE, NodeProcess, Probe, running
from sensor_msgs.msg import JointState

from continuum.kinematics.cable_estimate import estimate_configuration
from continuum.kinematics.cable_twist import arm_configuration_cable_jacobian
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.routing import tangle, tangle_rates
from continuum_manipulator.section_joints import read_joints
from continuum_msgs.msg import CableStates, ConfigEstimate

pytestmark = pytest.mark.ros

CABLES = ARM.cable_names
SD = 2e-3
"""Of a measured length [m]; a parameter of the node."""

N = 20
W, RATES = postures(N, seed=8)
LENGTHS = tangle(W, ARM) + SD * np.random.default_rng(8).normal(size=(N, len(CABLES)))


class Bench:
    """The estimator, and the node of forward kinematics that follows it."""

    def __init__(self, probe: Probe, node: NodeProcess) -> None:
        self.probe = probe
        self.node = node
        self.estimates = probe.hear(ConfigEstimate, "section_config_estimates")
        self.joints = probe.hear(JointState, "estimated_joint_states")
        self.poses = probe.hear(PoseStamped, "tip_pose")
        self.twists = probe.hear(TwistStamped, "tip_twist")
        self.say = probe.speaker(CableStates, "measured_cable_states").publish
        received = (self.estimates, self.joints, self.poses, self.twists)
        probe.warm_up(lambda: self.say(measured(0, LENGTHS[0], np.zeros(len(CABLES)))), *received)

    def send(self, *messages: CableStates) -> None:
        """Send messages, and hear what answers them."""
        for received in (self.estimates, self.joints, self.poses, self.twists):
            received.clear()
        for message in messages:
            self.say(message)
        self.probe.settle()


@pytest.fixture(scope="module")
def bench(domain):
    nodes = (
        NodeProcess(
            "continuum_manipulator", "cable_estimator", domain, files=(ARM_FILE,), parameters={"length_sd": SD}
        ),
        NodeProcess(
            "continuum_manipulator", "forward_kinematics", domain, files=(ARM_FILE,),
            arguments=("--ros-args", "-r", "joint_states:=estimated_joint_states", "--"),
        ),
    )  # fmt: skip
    with running(*nodes), Probe(domain) as probe:
        yield Bench(probe, nodes[0])


def measured(instant: int, lengths, rates=(), left_out=()) -> CableStates:
    """A message of all cables but those left out, in an order of the instant."""
    order = [i for i in np.random.default_rng(instant).permutation(len(CABLES)) if CABLES[i] not in left_out]
    velocities = [rates[i] for i in order] if len(rates) else ()
    return cables(instant, 0, [CABLES[i] for i in order], [lengths[i] for i in order], velocities)


def state_of(message: JointState):
    index = {name: k for k, name in enumerate(message.name)}
    states = [read_joints(index, message.position, message.velocity, section) for section in ARM.sections]
    rates = None if states[0].rate is None else np.array([one.rate for one in states])
    return np.array([one.w for one in states]), rates


def test_estimates_are_the_librarys(bench):
    bench.send(*(measured(k + 1, LENGTHS[k]) for k in range(N)))
    assert [(instant_of(one), one.section) for one in bench.estimates] == [
        (k + 1, i) for k in range(N) for i in (1, 2, 3)
    ]
    for message in bench.estimates:
        found = estimate_configuration(LENGTHS[instant_of(message) - 1], ARM, SD)
        i = message.section - 1
        assert message.header.frame_id == ARM.sections[i].base_frame
        np.testing.assert_allclose([message.u, message.v], found.w[i], atol=1e-12)
        np.testing.assert_allclose(message.covariance, found.section_covariance(i).reshape(-1), rtol=1e-9)
        assert tuple(message.name) == ARM.sections[i].cable_names
        np.testing.assert_allclose(message.residual, found.residuals[4 * i : 4 * i + 4], atol=1e-12)
        assert (message.chi_square, message.degrees_of_freedom) == (pytest.approx(found.chi_square), 6)
        assert message.status == ConfigEstimate.CONVERGED


def test_joints_carry_the_estimate_and_the_tip_follows(bench):
    rates = tangle_rates(W, RATES, ARM) + 1e-3 * np.random.default_rng(9).normal(size=LENGTHS.shape)
    bench.send(*(measured(100 + k, LENGTHS[k], rates[k]) for k in range(N)))
    assert [instant_of(one) for one in bench.joints] == [instant_of(one) for one in bench.poses]
    assert len(bench.joints) == len(bench.twists) == N
    for joints, pose, twist in zip(bench.joints, bench.poses, bench.twists, strict=True):
        k = instant_of(joints) - 100
        assert list(joints.name) == NAMES
        expected = estimate_configuration(LENGTHS[k], ARM, SD).w
        w, rate = state_of(joints)
        np.testing.assert_allclose(w, expected, atol=1e-9)
        expected_rate = (arm_configuration_cable_jacobian(expected, ARM) @ rates[k]).reshape(3, 2)
        np.testing.assert_allclose(rate, expected_rate, atol=1e-8)
        place, linear = pose.pose.position, twist.twist.linear
        np.testing.assert_allclose([place.x, place.y, place.z], arm_pose(expected, ARM)[:3, 3], atol=1e-9)
        velocity = (arm_jacobian(expected, ARM) @ expected_rate.reshape(-1))[:3]
        np.testing.assert_allclose([linear.x, linear.y, linear.z], velocity, atol=1e-8)


def test_cables_may_be_left_out(bench):
    gone = (CABLES[2], CABLES[4], CABLES[11])
    bench.send(measured(200, tangle(W[3], ARM), tangle_rates(W[3], RATES[3], ARM), left_out=gone))
    w, rate = state_of(bench.joints[0])
    np.testing.assert_allclose(w, W[3], atol=1e-9)
    np.testing.assert_allclose(rate, RATES[3], atol=1e-8)
    assert {name for one in bench.estimates for name in one.name} == set(CABLES) - set(gone)
    assert {one.degrees_of_freedom for one in bench.estimates} == {3}


def test_without_velocities_there_are_none(bench):
    bench.send(measured(210, LENGTHS[0]))
    assert len(bench.joints) == 1
    assert not bench.joints[0].velocity
    assert not bench.twists


def test_what_is_no_measurement_of_a_posture_is_refused_in_one_line(bench):
    wrong, beyond, unknown, infinite, of_a_section, zero = (measured(300, LENGTHS[0]) for _ in range(6))
    wrong.position[list(wrong.name).index(CABLES[9])] += 0.05
    bent = np.zeros((3, 2))
    bent[1] = 1.2 * ARM.sections[1].bend_limit, 0.0
    beyond.position = list(tangle(bent, ARM)[[CABLES.index(name) for name in beyond.name]])
    unknown.name = ["elbow", *list(unknown.name)[1:]]
    infinite.position[0] = np.inf
    of_a_section.section = 1
    zero.position[2] = 0.0
    few = measured(300, LENGTHS[0], left_out=CABLES[4:6])
    bench.send(wrong, beyond, unknown, infinite, of_a_section, zero, few, measured(301, LENGTHS[0]))
    assert [instant_of(one) for one in bench.joints] == [301]
    for line in (
        f"lengths that no posture has: measured_cable_states: residual of {CABLES[9]} is",
        "allowed: up to the tolerance, 0.01 m",
        "value out of range: measured_cable_states: bend of section_2 is",
        "unknown name: measured_cable_states: elbow",
        "not finite: measured_cable_states",
        f"{CABLES[4]}, {CABLES[5]} not in the message; 3 cables of section_2 are needed",
    ):
        bench.node.wait_for_line(line)
    probe = bench.probe
    probe.wait_for_report("cable_estimator")
    probe.wait_until(lambda: probe.count("cable_estimator", "dropped") == 7, lambda: probe.report("cable_estimator"))


def test_a_wider_tolerance_says_that_lengths_are_inconsistent(bench, domain):
    node = NodeProcess(
        "continuum_manipulator", "cable_estimator", domain, name="wide", files=(ARM_FILE,),
        parameters={"length_sd": 1e-6, "tolerance": 0.05},
        arguments=("--ros-args", "-r", "section_config_estimates:=wide_estimates", "-r",
                   "estimated_joint_states:=wide_joint_states", "--"),
    )  # fmt: skip
    with running(node):
        estimates = bench.probe.hear(ConfigEstimate, "wide_estimates")
        say = bench.probe.speaker(CableStates, "measured_cable_states", listeners=2).publish
        bench.probe.warm_up(lambda: say(measured(400, LENGTHS[0])), estimates)
        say(measured(401, LENGTHS[0]))
        bench.probe.wait_until(lambda: len(estimates) == 3, "an estimate of each section")
    assert {one.status for one in estimates} == {ConfigEstimate.INCONSISTENT}
