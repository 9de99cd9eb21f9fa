"""The section node over DDS: one message out for one in, by joint name, bad ones dropped and counted, and back."""

import math

import numpy as np
import pytest
from arm_messages import ARM, NAMES, cables, instant_of, joint_state, postures, stamp
from harness import ARM_FILE, NodeProcess, Probe, running
from sensor_msgs.msg import JointState

from continuum.kinematics.configuration import arc_length, curvature, jones_from_allen
from continuum.kinematics.routing import cables_through, section_length_rates, section_lengths
from continuum_manipulator.section_joints import joint_names, read_joints
from continuum_msgs.msg import CableStates, ConfigStates

pytestmark = pytest.mark.ros

NUMBER = 2
SECTION = ARM.sections[NUMBER - 1]
OWN = joint_names(SECTION)


class Bench:
    """A section node, and a probe on all of its topics."""

    def __init__(self, probe: Probe, node: NodeProcess) -> None:
        self.probe = probe
        self.node = node
        self.configs = probe.hear(ConfigStates, "section_config_states")
        self.cables = probe.hear(CableStates, "section_cable_states")
        self.joints = probe.hear(JointState, "section_joint_states")
        self.say_joints = probe.speaker(JointState, "joint_states").publish
        self.say_cables = probe.speaker(CableStates, "section_cable_commands").publish
        straight = joint_state(0, np.zeros((3, 2)))
        lengths = section_lengths(np.zeros(2), ARM, NUMBER - 1)[:4]
        probe.warm_up(lambda: self.say_joints(straight), self.configs, self.cables)
        probe.warm_up(lambda: self.say_cables(cables(0, NUMBER, SECTION.cable_names, lengths)), self.joints)

    def answers(self, messages: list[JointState]) -> list[CableStates]:
        """Send joint states, and the cable states that come until nothing comes any more."""
        self.cables.clear()
        self.configs.clear()
        for message in messages:
            self.say_joints(message)
        self.probe.listen_until_quiet()
        return list(self.cables)


@pytest.fixture(scope="module")
def bench(domain):
    node = NodeProcess(
        "continuum_manipulator", "section", domain, name="middle", files=(ARM_FILE,), parameters={"section": NUMBER}
    )
    with running(node), Probe(domain) as probe:
        yield Bench(probe, node)


def picked(message: JointState, order) -> JointState:
    """The message with its joints in another order, or with some of them."""
    result = JointState(header=message.header, name=[message.name[i] for i in order])
    result.position = [message.position[i] for i in order]
    if message.velocity:
        result.velocity = [message.velocity[i] for i in order]
    return result


def test_every_message_has_one_answer_of_its_stamp(bench):
    w, rates = postures(50)
    answers = bench.answers([joint_state(i, w[i], rates[i]) for i in range(1, 50)])
    assert [instant_of(message) for message in answers] == list(range(1, 50))
    assert [instant_of(message) for message in bench.configs] == list(range(1, 50))
    for message, config in zip(answers, bench.configs, strict=True):
        i = instant_of(message)
        own, own_rate = w[i, NUMBER - 1], rates[i, NUMBER - 1]
        assert message.section == config.section == NUMBER
        assert tuple(message.name) == cables_through(ARM, NUMBER - 1).names
        np.testing.assert_allclose(message.position, section_lengths(own, ARM, NUMBER - 1), rtol=1e-12)
        expected = section_length_rates(own, own_rate, ARM, NUMBER - 1)
        np.testing.assert_allclose(message.velocity, expected, rtol=1e-9, atol=1e-12)
        phi, theta = jones_from_allen(own)
        told = [config.u, config.v, config.phi, config.theta, config.s, config.kappa, config.u_rate, config.v_rate]
        length, kappa = arc_length(theta, SECTION), curvature(theta, SECTION)
        np.testing.assert_allclose(told, [*own, phi, theta, length, kappa, *own_rate], rtol=1e-9, atol=1e-12)


def test_joints_are_found_by_name_in_any_order(bench):
    w, rates = postures(2, seed=1)
    plain = joint_state(1, w[0], rates[0])
    order = np.random.default_rng(2).permutation(len(NAMES))
    own_only = [NAMES.index(name) for name in OWN]
    answers = bench.answers([plain, picked(plain, order), picked(plain, own_only)])
    assert len(answers) == 3
    assert answers[0].position == answers[1].position == answers[2].position
    assert answers[0].velocity == answers[1].velocity == answers[2].velocity


def test_unknown_velocity_stays_unknown(bench):
    w, _ = postures(1)
    (answer,) = bench.answers([joint_state(1, w[0])])
    assert not answer.velocity
    assert all(math.isnan(getattr(bench.configs[0], f"{name}_rate")) for name in ("u", "v", "s", "phi", "theta"))


def with_value(field: str, name: str, value: float) -> JointState:
    w, rates = postures(1)
    message = joint_state(7, w[0], rates[0])
    getattr(message, field)[NAMES.index(name)] = value
    return message


def without(*names: str) -> JointState:
    w, rates = postures(1)
    return picked(joint_state(7, w[0], rates[0]), [i for i, name in enumerate(NAMES) if name not in names])


def of_length(field: str, length: int, value: float = 0.1) -> JointState:
    w, rates = postures(1)
    message = joint_state(7, w[0], rates[0])
    setattr(message, field, [value] * length)
    return message


def named_twice() -> JointState:
    w, rates = postures(1)
    message = joint_state(7, w[0], rates[0])
    message.name = [NAMES[0], *NAMES[:-1]]
    return message


def of_joints(names: list[str]) -> JointState:
    message = JointState(name=names, position=[1.0])
    message.header.stamp = stamp(7)
    return message


def without_stamp() -> JointState:
    return JointState(name=NAMES, position=[0.1] * len(NAMES))


BAD_JOINTS = {
    "NaN": (lambda: with_value("position", OWN[0], math.nan), "not finite"),
    "infinite": (lambda: with_value("position", OWN[3], -math.inf), "not finite"),
    "NaN velocity": (lambda: with_value("velocity", OWN[1], math.nan), "not finite"),
    "velocities beyond all numbers": (lambda: of_length("velocity", len(NAMES), 1e308), "value out of range"),
    "impossible bend": (lambda: with_value("position", OWN[1], 50.0), "value out of range"),
    "missing joint": (lambda: without(OWN[2]), "missing name"),
    "missing phi": (lambda: without(OWN[0]), "missing name"),
    "no joint of the arm": (lambda: of_joints(["gripper"]), "missing name"),
    "no names": (lambda: of_joints([]), "missing name"),
    "no stamp": (lambda: without_stamp(), "no stamp"),
    "too few positions": (lambda: of_length("position", 4), "wrong length"),
    "NaN effort": (lambda: of_length("effort", len(NAMES), math.nan), "not finite"),
    "too few efforts": (lambda: of_length("effort", 2), "wrong length"),
    "too many velocities": (lambda: of_length("velocity", 99), "wrong length"),
    "repeated name": (lambda: named_twice(), "repeated name"),
}


def test_a_burst_is_told_in_two_lines(bench):
    before = bench.node.stderr
    assert bench.answers([of_length("position", 3)] * 100) == []
    bench.node.wait_for_line("wrong length: 100 in")
    first, summary = bench.node.stderr.removeprefix(before).splitlines()
    assert "dropped, wrong length: joint_states: position has 3 entries; allowed: 21" in first
    assert "wrong length: 100 in" in summary


def test_bad_joint_states_are_dropped_counted_and_survived(bench):
    probe = bench.probe
    probe.wait_for_report("middle")
    before = {cause: probe.count("middle", f"dropped: {cause}") for _, cause in BAD_JOINTS.values()}
    good = joint_state(9, postures(1)[0][0])
    mixed = [message for bad, _ in BAD_JOINTS.values() for message in (bad(), good)]
    answers = bench.answers(mixed)
    assert [instant_of(message) for message in answers] == [9] * len(BAD_JOINTS)
    for cause in before:
        expected = before[cause] + sum(cause == other for _, other in BAD_JOINTS.values())
        probe.wait_until(
            lambda c=cause, n=expected: probe.count("middle", f"dropped: {c}") == n, lambda: probe.report("middle")
        )
    assert probe.report("middle")["level"] == "WARN"


def test_joints_of_other_sections_are_no_fault(bench):
    probe = bench.probe
    probe.wait_for_report("middle")
    dropped, ignored = probe.count("middle", "dropped"), probe.count("middle", "ignored joint_states")
    assert bench.answers([without(*OWN)] * 3) == []
    probe.wait_until(lambda: probe.count("middle", "ignored joint_states") == ignored + 3, "three ignored")
    assert probe.count("middle", "dropped") == dropped


def test_commands_become_joints(bench):
    w, rates = postures(20, seed=3)
    own, own_rates = w[:, NUMBER - 1], rates[:, NUMBER - 1]
    lengths = section_lengths(own, ARM, NUMBER - 1)[:, :4]
    velocities = section_length_rates(own, own_rates, ARM, NUMBER - 1)[:, :4]
    bench.joints.clear()
    for i in range(20):
        bench.say_cables(cables(i, NUMBER, SECTION.cable_names[::-1], lengths[i, ::-1], velocities[i, ::-1]))
        bench.say_cables(cables(i, 1, ARM.sections[0].cable_names, lengths[i]))
    bench.say_cables(cables(20, NUMBER, SECTION.cable_names, lengths[0]))
    bench.probe.listen_until_quiet()
    assert [instant_of(message) for message in bench.joints] == list(range(21))
    for i, message in enumerate(bench.joints[:-1]):
        index = {name: k for k, name in enumerate(message.name)}
        state = read_joints(index, message.position, message.velocity, SECTION)
        np.testing.assert_allclose(state.w, own[i], atol=1e-9)
        np.testing.assert_allclose(state.rate, own_rates[i], atol=1e-8)
    assert not bench.joints[-1].velocity


def test_bad_commands_are_dropped(bench):
    lengths = section_lengths(np.zeros(2), ARM, NUMBER - 1)[:4]
    good = cables(1, NUMBER, SECTION.cable_names, lengths)
    bench.joints.clear()
    bench.say_cables(cables(2, 17, SECTION.cable_names, lengths))
    bench.say_cables(cables(2, NUMBER, SECTION.cable_names[:3], lengths[:3]))
    bench.say_cables(cables(2, NUMBER, SECTION.cable_names, [math.nan, *lengths[1:]]))
    bench.say_cables(cables(2, NUMBER, SECTION.cable_names, lengths[:2]))
    bench.say_cables(CableStates(section=NUMBER, name=list(SECTION.cable_names), position=lengths))
    bench.say_cables(cables(2, NUMBER, [], lengths))
    bench.say_cables(cables(2, NUMBER, SECTION.cable_names, [0.0] * 4))
    bench.say_cables(cables(2, NUMBER, SECTION.cable_names, [lengths[0] + 0.01, *lengths[1:]]))
    bench.say_cables(good)
    bench.probe.listen_until_quiet()
    assert [instant_of(message) for message in bench.joints] == [1]
    assert stamp(1) == bench.joints[0].header.stamp
    bench.node.wait_for_line(f"name is empty; list the cables: {', '.join(SECTION.cable_names)}")


def test_a_burst_without_stamps_is_told_once_with_the_remedy(bench):
    before = bench.node.stderr
    assert bench.answers([without_stamp()] * 50) == []
    bench.node.wait_for_line("no stamp: 50 in")
    first, _ = bench.node.stderr.removeprefix(before).splitlines()
    assert "joint_states: the message has no stamp; publish it with {header: {stamp: now}, ...}" in first
