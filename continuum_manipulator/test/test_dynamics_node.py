"""The dynamics node over DDS: states without gaps; tension commands good, bad, too large and missing; services."""

import math
import signal
import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
from harness import NodeProcess, Probe, running, wait_until
from harness.waiting import LONG
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from continuum.dynamics.live.live_arm import LiveArm
from continuum.dynamics.model_file import load_model
from continuum_manipulator.nodekit.stamps import NANOSECONDS, nanoseconds
from continuum_msgs.msg import CableStates
from continuum_msgs.srv import ResetArm

pytestmark = pytest.mark.ros

MODEL = load_model("lamecc_prototype.yaml")
CABLES = ["section_1_cable_1", "section_1_cable_2"]
PERIOD = NANOSECONDS / 120
TIMEOUT, SLACK_TIME = 2.0, 0.25
MOST, FASTEST = 15.0, 200.0


class Bench:
    """A dynamics node, and a probe on all of its topics and services."""

    def __init__(self, probe: Probe, node: NodeProcess, name: str) -> None:
        self.probe, self.node, self.name = probe, node, name
        self.joints = probe.hear(JointState, "joint_states")
        self.cables = probe.hear(CableStates, "cable_states")
        self._say = probe.speaker(CableStates, "cable_tension_cmd").publish
        self._release = probe.node.create_client(Trigger, f"{name}/release")
        self._reset = probe.node.create_client(ResetArm, f"{name}/reset")
        self.wait_for_states(1)

    def command(self, effort, names=CABLES, age: float = 0.0, stamped: bool = True) -> None:
        message = CableStates(name=list(names), effort=list(effort))
        if stamped:
            now = self.probe.node.get_clock().now().nanoseconds - round(age * NANOSECONDS)
            message.header.stamp.sec, message.header.stamp.nanosec = divmod(now, NANOSECONDS)
        self._say(message)

    def wait_for_states(self, n: int) -> None:
        """Until there are n more of both kinds than now."""
        joints, cables = len(self.joints) + n, len(self.cables) + n
        self.probe.wait_until(
            lambda: len(self.joints) >= joints and len(self.cables) >= cables, lambda: f"{n} states; {self.node.stderr}"
        )

    def pull(self, effort, until) -> None:
        """Command tensions, with every state that comes, until ``until(the latest cable states)``."""
        self.command(effort)
        while not until(self.cables[-1]):
            self.wait_for_states(2)
            self.command(effort)

    def call(self, client, request):
        self.probe.wait_until(client.service_is_ready, "the service")
        future = client.call_async(request)
        self.probe.wait_until(future.done, "its answer")
        return future.result()

    def release(self):
        return self.call(self._release, Trigger.Request())

    def reset(self, *position: float):
        return self.call(self._reset, ResetArm.Request(position=position))


@pytest.fixture(scope="module")
def bench(domain):
    parameters = {
        "max_tension": MOST,
        "max_tension_rate": FASTEST,
        "command_timeout": TIMEOUT,
        "slack_time": SLACK_TIME,
    }
    node = NodeProcess("continuum_manipulator", "dynamics", domain, parameters=parameters)
    with running(node), Probe(domain) as probe:
        yield Bench(probe, node, "dynamics")


@pytest.fixture
def at_rest(bench):
    """The bench with the arm straight, slack and at rest, and nothing heard yet."""
    assert bench.reset().success
    now = bench.probe.node.get_clock().now().nanoseconds
    bench.probe.wait_until(
        lambda: min(instants(bench.joints)[-1], instants(bench.cables)[-1]) > now, "states of after the reset"
    )
    bench.joints.clear()
    bench.cables.clear()
    bench.wait_for_states(1)
    return bench


def instants(messages) -> list[int]:
    return [nanoseconds(message.header.stamp) for message in messages]


def efforts(messages) -> np.ndarray:
    return np.array([message.effort for message in messages])


def assert_no_gap(messages) -> None:
    gaps = np.diff(instants(messages))
    assert np.all(np.abs(gaps - PERIOD) <= 1), gaps


def near(tension: float):
    return lambda message: abs(message.effort[0] - tension) < 1e-9


def test_blas_takes_one_thread():
    """What the executable imports before it sets the number of threads does not bring NumPy, which reads it."""
    code = "import sys, continuum_manipulator.dynamics_node as node; print('numpy' in sys.modules, node.main.__name__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=LONG, check=True)
    assert done.stdout.split() == ["False", "main"]


def test_states_have_the_workspaces_names_and_fit_each_other(at_rest):
    begun = (
        "lamecc_prototype.yaml, 5 joints, bent by 0 degrees in total, at 120 Hz by bdf; takes cable_tension_cmd; gives "
    )
    assert f"{begun}joint_states, cable_states\n" in at_rest.node.stderr
    at_rest.pull([10.0, 0.0], near(10.0))
    at_rest.release()
    at_rest.wait_for_states(20)
    assert_no_gap(at_rest.joints)
    assert_no_gap(at_rest.cables)
    arm = LiveArm(MODEL, np.zeros(5), "esdirk")
    cables = dict(zip(instants(at_rest.cables), at_rest.cables, strict=True))
    pairs = [
        (joints, cables[at])
        for at, joints in zip(instants(at_rest.joints), at_rest.joints, strict=True)
        if at in cables
    ]
    assert len(pairs) > 20
    for joints, cable in pairs:
        thetas = [f"section_1_theta_{i}" for i in range(1, 6)]
        assert list(joints.name) == ["section_1_phi", *thetas, "section_1_phi_back"]
        assert [joints.position[0], joints.position[-1], joints.velocity[0], joints.velocity[-1]] == [0.0] * 4
        assert not joints.effort
        assert (cable.section, list(cable.name)) == (CableStates.WHOLE_ARM, CABLES)
        arm.place([*joints.position[1:-1], *joints.velocity[1:-1]])
        np.testing.assert_allclose(cable.position, arm.cable_lengths, rtol=1e-12)
        np.testing.assert_allclose(cable.velocity, arm.cable_rates, rtol=1e-9, atol=1e-12)
    assert max(message.position[1] for message in at_rest.joints) > 0.01  # cable 1 bends towards positive angles
    assert all(message.velocity[0] < 0 for message in at_rest.cables if message.effort[0] > 9)


def test_tension_follows_no_faster_than_allowed_and_lets_go_when_commands_stop(at_rest):
    at_rest.pull([10.0, 2.0], near(10.0))
    held = len(at_rest.cables)
    last = at_rest.probe.node.get_clock().now().nanoseconds
    at_rest.probe.wait_until(lambda: not any(at_rest.cables[-1].effort), "slack cables")
    tension, at = efforts(at_rest.cables), np.array(instants(at_rest.cables))
    assert tension.max() <= 10.0 + 1e-9
    assert np.all(np.abs(np.diff(tension, axis=0)) <= FASTEST / 120 + 1e-6)  # periods are whole nanoseconds
    np.testing.assert_allclose(tension[held - 1], [10.0, 2.0])
    falling = at[(tension[:, 0] < 10.0 - 1e-9) & (np.arange(len(at)) >= held)]
    assert falling[0] <= last + TIMEOUT * NANOSECONDS + 2 * PERIOD
    slack = at[(tension.max(axis=1) == 0.0) & (np.arange(len(at)) >= held)][0]
    assert abs(slack - falling[0] - SLACK_TIME * NANOSECONDS) <= 3 * PERIOD
    at_rest.node.wait_for_line("tension commands stopped: none for 2 s; the cables are slack in 0.25 s")
    at_rest.probe.wait_until(
        lambda: at_rest.probe.report("dynamics").get("cables") == "commands stopped",
        lambda: at_rest.probe.report("dynamics"),
    )
    assert at_rest.probe.count("dynamics", "tension commands stopped") > 0
    assert at_rest.probe.report("dynamics")["level"] == "WARN"
    at_rest.pull([5.0, 0.0], near(5.0))  # and they may come again


BAD = {
    "not finite": [([math.nan, 1.0],), ([1.0, math.inf],)],
    "wrong length": [([1.0],), ([],)],
    "stale stamp": [([1.0, 1.0], CABLES, 5.0), ([1.0, 1.0], CABLES, -5.0)],
    "no stamp": [([1.0, 1.0], CABLES, 0.0, False)],
}


def test_bad_commands_are_dropped_counted_and_survived(at_rest):
    at_rest.probe.wait_for_report("dynamics")
    before = {cause: at_rest.probe.count("dynamics", f"dropped: {cause}") for cause in BAD}
    for cases in BAD.values():
        for case in cases:
            at_rest.command(*case)
    for cause, cases in BAD.items():
        expected = before[cause] + len(cases)
        at_rest.probe.wait_until(
            lambda c=cause, n=expected: at_rest.probe.count("dynamics", f"dropped: {c}") == n,
            lambda: at_rest.probe.report("dynamics"),
        )
    assert not np.any(efforts(at_rest.cables))
    assert_no_gap(at_rest.joints)
    at_rest.pull([3.0, 0.0], near(3.0))


def test_tension_stays_below_its_limit(at_rest):
    at_rest.pull([1e6, 0.0], near(MOST))
    at_rest.wait_for_states(5)
    assert efforts(at_rest.cables).max() == MOST
    at_rest.node.wait_for_line(f"tension limited: {CABLES[0]}: 1e+06 N commanded, max_tension is 15 N")


def test_release_drops_all_tension_at_once(at_rest):
    at_rest.pull([MOST, 0.0], near(MOST))
    held = len(at_rest.cables) - 1
    answer = at_rest.release()
    at_rest.wait_for_states(30)
    assert (answer.success, answer.message) == (True, "all cables are slack")
    tension = efforts(at_rest.cables)[held:, 0]
    drop = [(before, after) for before, after in pairwise(tension) if after < before]
    np.testing.assert_allclose(drop, [(MOST, 0.0)], rtol=1e-12)
    assert_no_gap(at_rest.joints)


def test_reset_sets_a_posture_at_rest(at_rest):
    at_rest.pull([MOST, 0.0], near(MOST))
    posture = [0.3, 0.2, 0.1, 0.0, -0.1]
    assert at_rest.reset(*posture).success
    at_rest.wait_for_states(10)
    times = instants(at_rest.joints)
    assert all(later > earlier for earlier, later in pairwise(times))
    away = [np.abs(np.array(message.position[1:-1]) - posture).max() for message in at_rest.joints]
    first = int(np.argmin(away))
    assert away[first] < 0.02  # one period after it was at rest there
    tension = efforts(at_rest.cables)
    assert not np.any(tension[instants(at_rest.cables).index(times[first]) :])
    for wrong in ([0.1], [math.nan] * 5, [4.0] * 5):
        answer = at_rest.reset(*wrong)
        assert not answer.success
        assert "allowed: 5 angles, each from -pi to pi rad" in answer.message


def test_being_held_up_is_reported_and_leaves_no_gap(at_rest):
    before = at_rest.node.stderr
    at_rest.node.send(signal.SIGSTOP)
    at_rest.probe.listen_until_quiet(0.6)
    stopped = instants(at_rest.joints)[-1]
    at_rest.node.send(signal.SIGCONT)
    at_rest.probe.wait_until(
        lambda: instants(at_rest.joints)[-1] > stopped + NANOSECONDS, "a second of states after the stop"
    )
    assert_no_gap(at_rest.joints)
    wait_until(lambda: "the machine is too busy" in at_rest.node.stderr.removeprefix(before), "a line about it")
    at_rest.probe.wait_for_report("dynamics")
    report = at_rest.probe.report("dynamics")
    assert int(report["behind"]) > 0
    assert {"real-time factor", "load of one core", "lag [s]", "integrator"} <= report.keys()
