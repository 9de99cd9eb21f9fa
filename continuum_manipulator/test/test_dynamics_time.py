"""The dynamics node by ``/clock``, with other models, and where the integration fails."""

import time
from collections.abc import Callable
from contextlib import contextmanager

import numpy as np
import pytest
import rclpy
from harness import NodeProcess, Probe, ended_in_any_case, wait_until
from harness.waiting import LONG
from rclpy.duration import Duration
from rclpy.experimental import EventsExecutor
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from continuum.dynamics.model_file import load_model, save_model
from continuum_manipulator.dynamics import DynamicsNode
from continuum_manipulator.nodekit.stamps import NANOSECONDS, nanoseconds
from continuum_manipulator.nodekit.tension_commands import LATE, STALE
from continuum_msgs.msg import CableStates
from continuum_msgs.srv import ResetArm

pytestmark = pytest.mark.ros

PERIOD = NANOSECONDS / 120
MODEL = load_model("lamecc_prototype.yaml")


@pytest.fixture
def probe(domain):
    with Probe(domain) as probe:
        yield probe


class SimulatedTime:
    """Says ``/clock``."""

    def __init__(self, probe: Probe) -> None:
        self._publisher = probe.speaker(Clock, "/clock", qos=10)
        self._probe = probe
        self.now = 1000 * NANOSECONDS

    def step(self, seconds: float) -> None:
        self.now += round(seconds * NANOSECONDS)
        clock = Clock()
        clock.clock.sec, clock.clock.nanosec = divmod(self.now, NANOSECONDS)
        self._publisher.publish(clock)

    def step_until(self, seconds: float, condition: Callable[[], object]) -> None:
        self._probe.wait_until(lambda: (self.step(seconds), condition())[1], "it, by simulated time")

    def repeat_until(self, condition: Callable[[], object]) -> None:
        """Say the same time again: a machine that was busy may have lost it."""
        self.step_until(0.0, condition)


def dynamics(domain: int, **parameters) -> NodeProcess:
    return NodeProcess("continuum_manipulator", "dynamics", domain, parameters={"integrator": "esdirk", **parameters})


@contextmanager
def dynamics_here(domain: int, **parameters):
    """The node in this process, and its executor."""
    words = [word for name, value in parameters.items() for word in ("-p", f"{name}:={value}")]
    rclpy.init(args=["--ros-args", "-p", "integrator:=esdirk", *words], domain_id=domain)
    node, executor = DynamicsNode(), EventsExecutor()
    executor.add_node(node)
    try:
        yield node, executor
    finally:
        executor.remove_node(node)
        node.destroy_node()
        rclpy.shutdown()


def stamps(messages) -> np.ndarray:
    return np.array([nanoseconds(message.header.stamp) for message in messages])


def test_simulated_time_sets_the_pace(domain, probe):
    """It runs ten times as fast, stands still, leaps forward, which leaves no gap, and goes back, which lets go."""
    joints, cables = probe.hear(JointState, "joint_states"), probe.hear(CableStates, "cable_states")
    with ended_in_any_case(dynamics(domain, use_sim_time=True, initial_bend=1.5)) as (node,):
        probe.wait_for_nodes("dynamics")
        clock = SimulatedTime(probe)
        clock.step_until(0.1, lambda: len(joints) > 60)
        clock.repeat_until(lambda: stamps(joints)[-1] > clock.now - PERIOD)  # half a period is left
        stood = len(joints)
        assert stamps(joints)[-1] <= clock.now
        probe.listen_until_quiet(0.5)
        assert len(joints) == stood
        clock.step(5.0)
        clock.repeat_until(lambda: stamps(joints)[-1] >= clock.now - 2 * PERIOD)
        assert np.all(np.abs(np.diff(stamps(joints)) - PERIOD) <= 1)
        assert abs(sum(joints[-1].position)) < 0.1 < 1.0 < sum(joints[0].position)  # released at the first instant
        say = probe.speaker(CableStates, "cable_tension_cmd").publish

        def pulled() -> bool:
            command = CableStates(name=["section_1_cable_1", "section_1_cable_2"], effort=[5.0, 0.0])
            command.header.stamp.sec, command.header.stamp.nanosec = divmod(clock.now, NANOSECONDS)
            say(command)
            return cables[-1].effort[0] > 4.0

        clock.step_until(0.02, pulled)
        clock.repeat_until(lambda: stamps(joints)[-1] >= clock.now - 2 * PERIOD)
        back = clock.now - 400 * NANOSECONDS
        clock.step(-500.0)
        clock.repeat_until(lambda: "time went back: by 500.000 s; the arm continues from its posture" in node.stderr)
        clock.step_until(0.02, lambda: stamps(cables)[-1] < back and not any(cables[-1].effort))
        instants = stamps(cables)
        pulling = instants[(instants < back) & np.array([any(one.effort) for one in cables])]
        assert np.ptp(pulling) < 2 * NANOSECONDS  # not until the time of the last command has passed again
        assert node.stop() == 0


def test_who_asks_is_answered_while_the_simulation_is_behind(domain, probe):
    """A leap of 60 s, which takes seconds to simulate, is broken off by a reset in its midst."""
    joints = probe.hear(JointState, "joint_states")
    parameters = {"integrator": "bdf", "use_sim_time": True, "initial_bend": 1.5, "command_timeout": 300.0}
    with ended_in_any_case(dynamics(domain, **parameters)) as (node,):
        reset = probe.node.create_client(ResetArm, "dynamics/reset")
        clock = SimulatedTime(probe)
        clock.step_until(0.1, lambda: len(joints) > 60 and reset.service_is_ready())
        before = stamps(joints)[-1]
        clock.step(60.0)
        probe.wait_until(lambda: stamps(joints)[-1] > before + NANOSECONDS, "the beginning of the leap")
        answer = reset.call_async(ResetArm.Request())
        probe.wait_until(answer.done, "the answer")
        probe.settle()
        assert stamps(joints)[-1] < clock.now - 10 * NANOSECONDS
        asked = clock.now
        clock.step_until(0.02, lambda: stamps(joints)[-1] > asked)
        assert node.stop() == 0


def test_a_late_node_does_not_blame_the_sender_and_pulls_no_longer_than_the_command_holds(domain, probe):
    """A command waits in the node for longer than it holds."""
    holds, cables = 0.1, probe.hear(CableStates, "cable_states")
    with dynamics_here(domain, command_timeout=holds, slack_time=holds) as (node, executor):

        def spin_until(condition: Callable[[], object]) -> None:
            probe.wait_until(lambda: (executor.spin_once(timeout_sec=0.01), condition())[1], "states of the node")

        publisher = probe.speaker(CableStates, "cable_tension_cmd")
        spin_until(lambda: cables)
        command = CableStates(name=["section_1_cable_1", "section_1_cable_2"], effort=[10.0, 0.0])
        command.header.stamp = probe.node.get_clock().now().to_msg()
        publisher.publish(command)
        assert publisher.wait_for_all_acked(Duration(seconds=LONG))
        given = nanoseconds(command.header.stamp)
        wait_until(lambda: time.time_ns() > given + 3 * holds * NANOSECONDS, "work of the node's elsewhere")
        spin_until(lambda: stamps(cables)[-1] > given + 4 * holds * NANOSECONDS)
        assert STALE not in node.diagnostics.faults.counts
        pulling = stamps(cables)[[any(one.effort) for one in cables]]
        assert given < pulling.max() <= given + 2 * holds * NANOSECONDS + 2 * PERIOD


def test_a_command_that_timed_out_in_the_node_does_not_begin_another_release(domain, probe):
    """Each of them would make what is left of the tension last for another slack time."""
    holds, cables = 0.1, probe.hear(CableStates, "cable_states")
    with dynamics_here(domain, command_timeout=holds, slack_time=holds) as (node, executor):

        def spin_until(condition: Callable[[], object]) -> None:
            probe.wait_until(lambda: (executor.spin_once(timeout_sec=0.01), condition())[1], "states of the node")

        def handle() -> bool:
            node._received_at = given  # the time at which it arrived
            node.checked("cable_tension_cmd", node._on_command)(command)
            return True

        spin_until(lambda: cables)
        command = CableStates(name=["section_1_cable_1", "section_1_cable_2"], effort=[10.0, 0.0])
        command.header.stamp = probe.node.get_clock().now().to_msg()
        given = nanoseconds(command.header.stamp)
        handle()
        spin_until(lambda: stamps(cables)[-1] > given + holds * NANOSECONDS + 3 * PERIOD)
        spin_until(lambda: handle() and stamps(cables)[-1] > given + 4 * holds * NANOSECONDS)
        assert node.diagnostics.faults.counts.keys() == {LATE}
        pulling = stamps(cables)[[any(one.effort) for one in cables]]
        assert given + holds * NANOSECONDS < pulling.max() <= given + 2 * holds * NANOSECONDS + 2 * PERIOD


def test_a_model_file_of_another_arm_is_simulated(domain, probe, tmp_path):
    """Bent by its springs' rest angles alone, as its file says."""
    save_model(MODEL.with_values({"rest_angle": 0.1, "gravity": 0.0}), tmp_path / "found.yaml")
    joints = probe.hear(JointState, "joint_states")
    angles = {"model": tmp_path / "found.yaml", "initial_angles": "[0.1, 0.1, 0.1, 0.1, 0.1]", "section": "elbow"}
    with ended_in_any_case(dynamics(domain, **angles)) as (node,):
        probe.wait_until(lambda: len(joints) > 30, lambda: f"states; {node.stderr}")
        assert joints[-1].name[1] == "elbow_theta_1"
        np.testing.assert_allclose(joints[-1].position[1:-1], 0.1, atol=1e-9)
        assert node.stop() == 0


def test_a_failed_integration_is_reported_and_ends_with_a_reset(domain, probe, tmp_path):
    wild = {"hole_radius": 10.0, "half_spacing": 10.0, "capstan_friction": 2.0, "cable_slope": 1e6}
    save_model(MODEL.with_values(wild), tmp_path / "wild.yaml")
    joints = probe.hear(JointState, "joint_states")
    limits = {"max_tension": 1e4, "max_tension_rate": 1e6}
    with ended_in_any_case(dynamics(domain, model=tmp_path / "wild.yaml", **limits)) as (node,):
        say = probe.speaker(CableStates, "cable_tension_cmd").publish
        reset = probe.node.create_client(ResetArm, "dynamics/reset")
        probe.wait_until(lambda: len(joints) > 10 and reset.service_is_ready(), lambda: f"states; {node.stderr}")
        command = CableStates(name=["section_1_cable_1", "section_1_cable_2"], effort=[1e4, 0.0])
        command.header.stamp = probe.node.get_clock().now().to_msg()
        say(command)
        node.wait_for_line("integration failed: no step was small enough")
        probe.settle()
        stood = len(joints)
        assert np.all(np.isfinite(joints[-1].position))
        answer = reset.call_async(ResetArm.Request())
        probe.wait_until(lambda: answer.done() and len(joints) > stood + 10, "states after the reset")
        assert answer.result().success
        assert node.stderr.count("integration failed") <= 2  # at once, and summed up
        assert node.stop() == 0
