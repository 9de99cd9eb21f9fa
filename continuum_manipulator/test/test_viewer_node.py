"""The viewer over DDS: what it refuses, that it lives on, and who looks and leaves."""

import itertools
import signal
import subprocess
import sys
import urllib.request

import numpy as np
import pytest
from arm_messages import cables, joint_state, pose, postures
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped
from harness import ARM_FILE, NodeProcess, Probe, ended_in_any_case, running
from harness.waiting import LONG
from sensor_msgs.msg import JointState

from continuum_manipulator.nodekit.qos import REPORT
from continuum_msgs.msg import CableStates

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module")
def probe(domain):
    node = NodeProcess("continuum_manipulator", "viewer", domain, files=(ARM_FILE,), parameters={"port": 0})
    with running(node), Probe(domain) as probe:
        probe.wait_until(lambda: probe.report("viewer").get("address"), "the viewer")
        yield probe


def page_of(probe) -> str:
    with urllib.request.urlopen(probe.report("viewer")["address"], timeout=LONG) as answer:
        return answer.read().decode()


def test_page_is_served_on_this_host_alone(probe):
    assert probe.report("viewer")["address"].startswith("http://127.0.0.1:")
    assert "<html" in page_of(probe)


def test_bad_messages_are_counted_and_the_page_lives(probe):
    w = postures(1)[0][0]
    joints = probe.speaker(JointState, "joint_states").publish
    lengths = probe.speaker(CableStates, "cable_states").publish
    targets = probe.speaker(PoseStamped, "traj_pose").publish
    not_finite, strange, short = (joint_state(1, w) for _ in range(3))
    not_finite.position[3] = np.nan
    strange.name = [f"other_{name}" for name in strange.name]
    short.position = short.position[:5]
    names = ["section_1_cable_1", "section_1_cable_2"]
    bad = [
        ("not finite", lambda: joints(not_finite)),
        ("missing name", lambda: joints(strange)),
        ("wrong length", lambda: joints(short)),
        ("unknown name", lambda: lengths(cables(1, 0, ["section_9_cable_1"], [0.1]))),
        ("repeated name", lambda: lengths(cables(1, 0, [names[0]] * 2, [0.1, 0.2]))),
        ("wrong frame", lambda: targets(pose(1, (0.0, 0.0, 0.1), frame="elsewhere"))),
    ]
    for cause, send in bad:
        before = probe.count("viewer", f"dropped: {cause}")

        def counted(cause=cause, send=send, before=before):
            send()  # a reader that takes the newest alone may not have heard the first
            return probe.count("viewer", f"dropped: {cause}") > before

        probe.wait_until(counted, f"{cause} counted; {probe.report('viewer')}")
    assert "<html" in page_of(probe)


def test_a_browser_that_stalls_or_leaves_holds_nobody_up(probe):
    """Frames are drawn while one is there, if it takes them or not, and none once all have left."""
    joints = probe.speaker(JointState, "joint_states").publish
    way = [joint_state(k, w) for k, w in enumerate(postures(200)[0])]
    looker = subprocess.Popen(
        [sys.executable, "-m", "tools.benchmarks.viewer.looker", probe.report("viewer")["address"]]
    )
    try:
        probe.wait_until(lambda: probe.count("viewer", "browsers") == 1, "a browser")
        looker.send_signal(signal.SIGSTOP)
        before, received = probe.count("viewer", "frames"), probe.count("viewer", "received joint_states")
        sent = itertools.cycle(way)

        def went_on():
            joints(next(sent))
            return (
                probe.count("viewer", "frames") > before + 60
                and probe.count("viewer", "received joint_states") > received + 60
            )

        probe.wait_until(went_on, lambda: f"frames and messages beside a browser that stalls: {probe.report('viewer')}")
        probe.wait_until(
            lambda: (joints(next(sent)), probe.count("viewer", "browsers") == 0)[1],
            "the browser that stalls sent away, which may hold cables tight",
            2 * LONG,
        )
    finally:
        looker.kill()
        looker.wait()
    probe.wait_until(lambda: probe.count("viewer", "browsers") == 0, "nobody looking")
    probe.wait_for_report("viewer")
    frames = probe.count("viewer", "frames")
    probe.wait_for_report("viewer")
    assert probe.count("viewer", "frames") == frames


def test_statuses_without_end_are_not_kept(probe):
    say = probe.speaker(DiagnosticArray, "/diagnostics", listeners=2, qos=REPORT).publish
    for k in range(5):
        say(DiagnosticArray(status=[DiagnosticStatus(name=f"{k} {i}" * 1000, message="m" * 5000) for i in range(100)]))
    probe.wait_for_report("viewer")
    assert "<html" in page_of(probe)


def test_ends_cleanly_without_a_file_for_the_arm(domain):
    node = NodeProcess("continuum_manipulator", "viewer", domain, name="usual", parameters={"port": 0})
    with ended_in_any_case(node):
        node.wait_for_line("in a browser")
        assert node.stop() == 0
