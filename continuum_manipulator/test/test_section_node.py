"""The section node over DDS: one message out for one in, by joint name, bad ones dropped and counted, and back."""

import math

import numpy as np
import pytest
from arm_messages import ARM, NAMES, cables, instant_of, joint_state, postures, stamp
from harness import ARM_FILE, NodeProcess, Probe, running
from sensor_msgs.msg import JointState

from continuum.kinematics.cable_lines import cable_lines
from continuum.kinematics.configuration import allen_from_jones, arc_length, curvature, jones_from_allen, jones_rates
from continuum.kinematics.discs import even_bends
from continuum.kinematics.routing import cables_through, section_length_rates, section_lengths
from continuum_manipulator.section_joints import joint_names, read_joints
from continuum_msgs.msg import CableStates, ConfigStates

pytestmark = pytest.mark.ros

NUMBER = 2
SECTION = ARM.sections[NUMBER - 1]
PER_RUN = joint_names(SECTION)


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
        """Send joint states, and return the cable states that answer them."""
        self.cables.clear()
        self.configs.clear()
        for message in messages:
            self.say_joints(message)
        self.probe.settle()
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
        own, actuating_rate = w[i, NUMBER - 1], rates[i, NUMBER - 1]
        assert message.section == config.section == NUMBER
        assert tuple(message.name) == cables_through(ARM, NUMBER - 1).names
        np.testing.assert_allclose(message.position, section_lengths(own, ARM, NUMBER - 1), rtol=1e-12)
        expected = section_length_rates(own, actuating_rate, ARM, NUMBER - 1)
        np.testing.assert_allclose(message.velocity, expected, rtol=1e-9, atol=1e-12)
        phi, theta = jones_from_allen(own)
        output = [config.u, config.v, config.phi, config.theta, config.s, config.kappa, config.u_rate, config.v_rate]
        length, kappa = arc_length(theta, SECTION), curvature(theta, SECTION)
        np.testing.assert_allclose(output, [*own, phi, theta, length, kappa, *actuating_rate], rtol=1e-9, atol=1e-12)


def test_joints_are_found_by_name_in_any_order(bench):
    w, rates = postures(2, seed=1)
    plain = joint_state(1, w[0], rates[0])
    order = np.random.default_rng(2).permutation(len(NAMES))
    actuating_only = [NAMES.index(name) for name in PER_RUN]
    answers = bench.answers([plain, picked(plain, order), picked(plain, actuating_only)])
    assert len(answers) == 3
    assert answers[0].position == answers[1].position == answers[2].position
    assert answers[0].velocity == answers[1].velocity == answers[2].velocity


def test_unknown_velocity_stays_unknown(bench):
    w, _ = postures(1)
    (answer,) = bench.answers([joint_state(1, w[0])])
    assert not answer.velocity
    assert all(math.isnan(getattr(bench.configs[0], f"{name}_rate")) for name in ("u", "v", "s", "phi", "theta"))


def test_cables_are_those_of_the_single_joints(bench):
    """Lengths of the lines through the discs, and their slope; the configuration is that of the joints' sum."""
    random, step = np.random.default_rng(5), 1e-4
    phi, phi_rate = random.uniform(-3, 3), 0.4
    thetas, theta_rates = random.uniform(-0.3, 0.3, SECTION.n_joints), random.uniform(-1, 1, SECTION.n_joints)

    def lengths_at(time: float) -> np.ndarray:
        bends = [even_bends(np.zeros(2), section) for section in ARM.sections]
        bends[NUMBER - 1] = allen_from_jones(np.float64(phi + time * phi_rate), thetas + time * theta_rates)
        lines = [line.points for line in cable_lines(bends, ARM) if line.section == NUMBER - 1]
        return np.array([np.linalg.norm(np.diff(points, axis=0), axis=1).sum() for points in lines])

    message = JointState(name=[SECTION.phi_joint, *SECTION.theta_joints], position=[phi, *thetas])
    message.velocity, message.header.stamp = [phi_rate, *theta_rates], stamp(1)
    (answer,) = bench.answers([message])
    np.testing.assert_allclose(answer.position, lengths_at(0.0), rtol=1e-12)
    np.testing.assert_allclose(answer.velocity, (lengths_at(step) - lengths_at(-step)) / (2 * step), atol=1e-8)
    np.testing.assert_allclose([bench.configs[0].u, bench.configs[0].v], allen_from_jones(phi, thetas.sum()))
    assert np.abs(answer.position - section_lengths(allen_from_jones(phi, thetas.sum()), ARM, NUMBER - 1)).max() > 1e-5


def test_bad_joint_states_are_dropped_counted_reported_in_few_lines_and_survived(bench):
    probe, before = bench.probe, bench.node.stderr
    probe.wait_for_report("middle")
    dropped, ignored = probe.count("middle", "dropped: not finite"), probe.count("middle", "ignored joint_states")
    good, bad = (joint_state(instant, postures(1)[0][0]) for instant in (9, 7))
    bad.position[NAMES.index(PER_RUN[0])] = math.nan
    others = picked(joint_state(7, postures(1)[0][0]), [i for i, name in enumerate(NAMES) if name not in PER_RUN])
    answers = bench.answers([bad, others, good] * 50)
    assert [instant_of(message) for message in answers] == [9] * 50
    probe.wait_until(
        lambda: (
            probe.count("middle", "dropped: not finite") == dropped + 50
            and probe.count("middle", "ignored joint_states") == ignored + 50
        ),
        lambda: probe.report("middle"),
    )
    assert probe.report("middle")["level"] == "WARN"

    def lines() -> list[str]:
        return bench.node.stderr.removeprefix(before).splitlines()

    probe.wait_until(lambda: len(lines()) > 1, "a summary")
    assert f"dropped, not finite: joint_states: position of {PER_RUN[0]}" in lines()[0]
    assert len(lines()) < 10  # two, unless the machine holds the node up for a second: then another burst begins


def test_commands_become_joints(bench):
    w, rates = postures(20, seed=3)
    own, actuating_rates = w[:, NUMBER - 1], rates[:, NUMBER - 1]
    lengths = section_lengths(own, ARM, NUMBER - 1)[:, :4]
    velocities = section_length_rates(own, actuating_rates, ARM, NUMBER - 1)[:, :4]
    bench.joints.clear()
    for i in range(20):
        bench.say_cables(cables(i, NUMBER, SECTION.cable_names[::-1], lengths[i, ::-1], velocities[i, ::-1]))
        bench.say_cables(cables(i, 1, ARM.sections[0].cable_names, lengths[i]))
    bench.say_cables(cables(20, NUMBER, SECTION.cable_names, lengths[0]))
    bench.probe.settle()
    assert [instant_of(message) for message in bench.joints] == list(range(21))
    for i, message in enumerate(bench.joints[:-1]):
        index = {name: k for k, name in enumerate(message.name)}
        state = read_joints(index, message.position, message.velocity, SECTION)
        np.testing.assert_allclose(state.w, own[i], atol=1e-9)
        np.testing.assert_allclose(state.rate, actuating_rates[i], atol=1e-8)
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
    bench.probe.settle()
    assert [instant_of(message) for message in bench.joints] == [1]
    assert stamp(1) == bench.joints[0].header.stamp
    bench.node.wait_for_line(f"name is empty; list the cables: {', '.join(SECTION.cable_names)}")


def config(instant: int, **values: float) -> ConfigStates:
    """A command; what is not given is NaN."""
    names = ("u", "v", "phi", "theta", "u_rate", "v_rate", "phi_rate", "theta_rate")
    message = ConfigStates(section=NUMBER)
    for name, value in (dict.fromkeys(names, math.nan) | values).items():
        setattr(message, name, float(value))
    message.header.stamp = stamp(instant)
    return message


def test_a_commanded_configuration_becomes_joints_and_cables(bench):
    """In either parametrisation; both say the same of one configuration."""
    say = bench.probe.speaker(ConfigStates, "section_config_commands").publish
    w, rate = np.array([0.3, -0.5]), np.array([0.2, 0.7])
    phi, theta = jones_from_allen(w)
    phi_rate, theta_rate = jones_rates(w, rate)
    for received in (bench.joints, bench.cables, bench.configs):
        received.clear()
    say(config(400, u=0.3, v=-0.5, u_rate=0.2, v_rate=0.7))
    say(config(401, phi=phi, theta=theta, phi_rate=phi_rate, theta_rate=theta_rate))
    bench.probe.wait_until(lambda: len(bench.joints) == len(bench.cables) == 2, "two answers")
    for joints, answer in zip(bench.joints, bench.cables, strict=True):
        index = {name: k for k, name in enumerate(joints.name)}
        read = read_joints(index, joints.position, joints.velocity, SECTION)
        np.testing.assert_allclose(read.w, w, atol=1e-12)
        np.testing.assert_allclose(read.rate, rate, atol=1e-12)
        np.testing.assert_allclose(answer.position, section_lengths(w, ARM, NUMBER - 1), rtol=1e-12)
        np.testing.assert_allclose(answer.velocity, section_length_rates(w, rate, ARM, NUMBER - 1), atol=1e-12)


def test_configurations_that_cannot_be_are_dropped_and_the_node_lives(bench):
    say = bench.probe.speaker(ConfigStates, "section_config_commands").publish
    bench.joints.clear()
    for bad in (config(500), config(501, u=0.1), config(502, u=9.0, v=0.0), config(503, phi=math.inf, theta=0.1)):
        say(bad)
    say(config(504, u=0.1, v=0.0))
    bench.probe.wait_until(lambda: bench.joints, "an answer")
    bench.probe.settle()
    assert [instant_of(message) for message in bench.joints] == [504]
