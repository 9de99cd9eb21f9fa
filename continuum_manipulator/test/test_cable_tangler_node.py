"""The tangler over DDS: instants are never mixed; and through tangler and sections, commands give back the joints."""

import math

import numpy as np
import pytest
from arm_messages import ARM, cables, instant_of, postures
from builtin_interfaces.msg import Time
from harness import ARM_FILE, NodeProcess, Probe, running
from sensor_msgs.msg import JointState

from continuum.kinematics.routing import cables_through, section_lengths, tangle, tangle_rates
from continuum_msgs.msg import CableStates

pytestmark = pytest.mark.ros

N = 12
W, RATES = postures(N, seed=4)


class Bench:
    """The tangler alone, with the probe in the place of the sections."""

    def __init__(self, probe: Probe, node: NodeProcess) -> None:
        self.probe = probe
        self.node = node
        self.totals = probe.hear(CableStates, "cable_states")
        self.commands = probe.hear(CableStates, "section_cable_commands")
        self.say_section = probe.speaker(CableStates, "section_cable_states").publish
        self.say_command = probe.speaker(CableStates, "cable_commands").publish
        probe.warm_up(self._send_all, self.totals, self.commands)

    def _send_all(self) -> None:
        for instant in (0, 1):  # sent again, the first begins a new run: one instant alone is summed once
            for section in (1, 2, 3):
                self.say_section(part(instant, section))
        self.say_command(command(0))

    def totals_after(self, messages: list[CableStates]) -> list[CableStates]:
        self.totals.clear()
        for message in messages:
            self.say_section(message)
        self.probe.settle()
        return list(self.totals)


@pytest.fixture(scope="module")
def bench(domain):
    node = NodeProcess("continuum_manipulator", "cable_tangler", domain, files=(ARM_FILE,))
    with running(node), Probe(domain) as probe:
        yield Bench(probe, node)


def part(instant: int, section: int, base: int = 0, velocity=()) -> CableStates:
    """What a section says at an instant; ``base`` instants on, the same postures again."""
    lengths = section_lengths(W[instant % N, section - 1], ARM, section - 1)
    return cables(base + instant, section, cables_through(ARM, section - 1).names, lengths, velocity)


def command(instant: int) -> CableStates:
    lengths, velocities = tangle(W[instant], ARM), tangle_rates(W[instant], RATES[instant], ARM)
    order = np.random.default_rng(instant).permutation(len(lengths))
    return cables(instant, 0, [ARM.cable_names[i] for i in order], lengths[order], velocities[order])


def check_totals(totals, instants, base):
    assert [instant_of(message) - base for message in totals] == instants
    for message in totals:
        assert tuple(message.name) == ARM.cable_names
        assert message.section == CableStates.WHOLE_ARM
        np.testing.assert_allclose(message.position, tangle(W[(instant_of(message) - base) % N], ARM), rtol=1e-12)


def test_interleaved_instants_are_kept_apart(bench):
    base = 1000
    order = [(i, 1) for i in range(N)] + [(i, 3) for i in range(N)] + [(i, 2) for i in range(N)]
    totals = bench.totals_after([part(i, section, base) for i, section in order])
    check_totals(totals, list(range(N)), base)
    assert not any(message.velocity for message in totals)


def test_lost_and_late_partners(bench):
    base = 2000
    probe = bench.probe
    lost = {(2, 1), (5, 3), (6, 2)}
    sent = [(i, section) for i in range(9) for section in (3, 1, 2) if (i, section) not in lost]
    late = [(2, 1)]
    probe.wait_for_report("cable_tangler")
    key = "instants given up with a section missing"
    before = probe.count("cable_tangler", key)
    totals = bench.totals_after([part(i, section, base) for i, section in sent + late])
    check_totals(totals, [0, 1, 3, 4, 7, 8], base)
    probe.wait_until(lambda: probe.count("cable_tangler", key) == before + 3, lambda: probe.report("cable_tangler"))
    assert probe.report("cable_tangler")["level"] == "WARN"
    bench.node.wait_for_line("instants given up with a section missing: at 120.020000000 s: no state of section 1")


def test_a_section_that_is_silent_is_named_and_nothing_is_given_up(bench):
    base = 2200
    bench.totals_after([part(-1, section, base) for section in (1, 2, 3)])  # what others left waiting is given up
    bench.totals_after([part(i, section, base) for i in range(400) for section in (1, 3)])
    bench.node.wait_for_line("section states missing: at 122.000000000 s: no state of section 2 yet; 400 instants wait")
    check_totals(bench.totals_after([part(i, 2, base) for i in range(400)]), list(range(400)), base)


def test_an_instant_sent_again_is_warned_of(bench):
    """As by one who publishes by hand, always with the same stamp."""
    base = 2500
    messages = [part(0, section, base) for section in (1, 2, 3)]
    probe = bench.probe
    probe.wait_for_report("cable_tangler")
    key = "section states too late"
    before = probe.count("cable_tangler", key)
    check_totals(bench.totals_after(messages + messages), [0], base)
    bench.node.wait_for_line(f"{key}: at 125.000000000 s: section 1; this instant, or a later one, has been published")
    probe.wait_until(lambda: probe.count("cable_tangler", key) == before + 3, lambda: probe.report("cable_tangler"))
    assert probe.report("cable_tangler")["level"] == "WARN"
    bench.totals_after([part(1, 2, base)] * 2)
    bench.node.wait_for_line("section states repeated: at 125.010000000 s: section 2 again")


def test_velocity_is_known_only_if_all_sections_know_it(bench):
    base = 3000
    velocity = {section: [0.01 * section] * len(cables_through(ARM, section - 1).names) for section in (1, 2, 3)}
    messages = [part(0, section, base, velocity[section]) for section in (1, 2, 3)]
    messages += [part(1, section, base, velocity[section] if section < 3 else ()) for section in (1, 2, 3)]
    known, unknown = bench.totals_after(messages)
    np.testing.assert_allclose(known.velocity, [0.01] * 4 + [0.03] * 4 + [0.06] * 4)
    assert not unknown.velocity


def test_bad_section_states_do_not_enter_a_sum(bench):
    base = 4000
    nan = part(0, 1, base)
    nan.position[0] = math.nan
    short = part(0, 1, base)
    short.position.pop()
    unnamed = part(0, 1, base)
    unnamed.name = ["x", *list(unnamed.name)[1:]]
    stranger = part(0, 1, base)
    stranger.section = 9
    good = [part(0, section, base) for section in (1, 2, 3)]
    check_totals(bench.totals_after([nan, short, unnamed, stranger, *good]), [0], base)
    causes = ("not finite", "wrong length", "missing name", "value out of range")
    probe = bench.probe
    probe.wait_until(
        lambda: all(probe.count("cable_tangler", f"dropped: {cause}") for cause in causes),
        lambda: probe.report("cable_tangler"),
    )


def test_commands_name_the_section_and_its_own_cables(bench):
    bench.commands.clear()
    bench.say_command(command(1))
    bad = command(2)
    bad.position[3] = math.inf
    bench.say_command(bad)
    unnamed, unstamped = command(2), command(2)
    unnamed.name = []
    unstamped.header.stamp = Time()
    elsewhere = command(2)
    elsewhere.position[0] += 0.01
    bench.say_command(elsewhere)
    bench.say_command(unnamed)
    bench.say_command(unstamped)
    bench.probe.settle()
    assert [message.section for message in bench.commands] == [1, 2, 3]
    bench.node.wait_for_line(f"cable_commands: name is empty; list the cables: {', '.join(ARM.cable_names)}")
    bench.node.wait_for_line("cable_commands: the message has no stamp; publish it with {header: {stamp: now}, ...}")
    for i, message in enumerate(bench.commands):
        assert tuple(message.name) == ARM.sections[i].cable_names
        np.testing.assert_allclose(message.position, section_lengths(W[1, i], ARM, i)[:4], rtol=1e-9)


def test_a_wider_tolerance_takes_lengths_of_no_posture(bench, domain):
    """To both nodes that take commands; by default 10 mm too much are refused, as above."""
    off = command(2)
    off.position[0] += 0.01
    lengths = section_lengths(np.zeros(2), ARM, 0)[:4]
    lengths[0] += 0.01
    of_section = cables(2, 1, ARM.sections[0].cable_names, lengths)
    wide = {"tolerance": 0.02}
    nodes = (
        NodeProcess(
            "continuum_manipulator", "cable_tangler", domain, name="wide", files=(ARM_FILE,), parameters=wide,
            arguments=("--ros-args", "-r", "section_cable_commands:=wide_commands", "--"),
        ),
        NodeProcess("continuum_manipulator", "section", domain, files=(ARM_FILE,), parameters=wide | {"section": 1}),
    )  # fmt: skip
    with running(*nodes):
        commands = bench.probe.hear(CableStates, "wide_commands")
        joints = bench.probe.hear(JointState, "section_joint_states")
        say = bench.probe.speaker(CableStates, "cable_commands", listeners=2).publish
        say_section = bench.probe.speaker(CableStates, "section_cable_commands").publish
        bench.probe.warm_up(lambda: (say(off), say_section(of_section)), commands, joints)
