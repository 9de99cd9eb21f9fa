"""What the viewer's page asks of the arm, over DDS: published while the browser that asks is there, and nobody else."""

import contextlib

import numpy as np
import pytest
import rclpy
from arm_messages import ARM, cables, joint_state, pose, postures
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from domain_coordinator import domain_id
from geometry_msgs.msg import PoseStamped
from harness import NodeProcess, Probe, running
from harness.visitor import Visitor
from sensor_msgs.msg import JointState
from websockets.exceptions import InvalidStatus

from continuum.kinematics.chain import arm_pose
from continuum.viewer.section_angles import configuration_of_joints
from continuum_manipulator.nodekit.qos import REPORT
from continuum_manipulator.nodekit.stamps import nanoseconds
from continuum_manipulator.viewer import NotDrawnError, ViewerNode
from continuum_msgs.msg import CableStates

pytestmark = pytest.mark.ros

TOPICS = ("/cable_tension_cmd", "/traj_pose", "/joint_states")
CABLES = ["section_1_cable_1", "section_1_cable_2"]
SLIDER = "section 1 cable 1 [N]"
TAKE, LEAD = "Take control", "You move"


class Bench:
    """A viewer, and what it says."""

    def __init__(self, probe, node):
        self.probe, self.node = probe, node
        self.tensions = probe.hear(CableStates, "cable_tension_cmd")
        self.targets = probe.hear(PoseStamped, "traj_pose")
        self.joints = probe.hear(JointState, "joint_states")
        probe.wait_until(lambda: probe.report("viewer").get("address"), "the viewer")
        self.address = probe.report("viewer")["address"]
        self._say_cables = probe.speaker(CableStates, "cable_states").publish

    def visitor(self):
        return Visitor(self.address, self.address)

    def wait(self, condition, what):
        """Meanwhile somebody says the tensions of two cables."""

        def met():
            self._say_cables(CableStates(name=CABLES, effort=[1.0, 1.0]))
            return condition()

        self.probe.wait_until(met, what)

    def pull(self, visitor, tension):
        self.wait(lambda: self.probe.count("viewer", "received cable_states") > 0, "tensions heard")
        self.tensions.clear()
        visitor.put(TAKE, True)
        self.wait(lambda: self.tensions and not any(self.tensions[-1].effort), "control, and nothing pulled")
        visitor.put(SLIDER, tension)

    def wait_for_tension(self, tension):
        self.wait(lambda: self.tensions and self.tensions[-1].effort[0] == tension, f"{tension} N")

    def wait_for_silence(self, received):
        def quiet():
            before = len(received)
            self.probe.wait_for_report("viewer")
            return len(received) == before

        self.wait(quiet, "silence")

    def advertises(self, topic):
        return any(end.node_name == "viewer" for end in self.probe.node.get_publishers_info_by_topic(topic))

    def wait_until_silent(self, topic, say):
        """The viewer publishes nothing from one report to the third after it, while another node says the same."""
        counts = []

        def silent():
            say()
            if self.probe.report("viewer"):
                counts.append(self.probe.count("viewer", f"published {topic}"))
                self.probe.forget("viewer")
            return len(counts) > 3 and len(set(counts[-4:])) == 1

        self.wait(silent, f"{topic} left to the other")


@contextlib.contextmanager
def started(domain):
    node = NodeProcess("continuum_manipulator", "viewer", domain, parameters={"port": 0, "max_tension": 30.0})
    with running(node), Probe(domain) as probe:
        yield Bench(probe, node)


@pytest.fixture(scope="module")
def viewer(domain):
    with started(domain) as bench:
        yield bench


@pytest.fixture
def bench(viewer):
    """The viewer with nobody at its page, and nothing heard yet."""
    viewer.wait(lambda: not any(map(viewer.advertises, TOPICS)), "nobody at the page")
    for received in (viewer.tensions, viewer.targets, viewer.joints):
        received.clear()
    return viewer


def test_cables_are_pulled_by_a_slider_and_slack_once_control_is_given_back(bench):
    with bench.visitor() as visitor:
        bench.pull(visitor, 12.0)
        bench.wait_for_tension(12.0)
        assert list(bench.tensions[-1].name) == CABLES
        assert nanoseconds(bench.tensions[-1].header.stamp) > 0
        visitor.put(SLIDER, 500.0)
        bench.wait_for_tension(30.0)
        visitor.put(TAKE, False)
        bench.wait_for_tension(0.0)
        bench.wait_for_silence(bench.tensions)
        bench.pull(visitor, 3.0)
        bench.wait_for_tension(3.0)
    assert set(map(len, (bench.targets, bench.joints))) == {0}


def test_cables_are_slack_once_the_browser_that_pulls_has_left_also_next_to_another(bench):
    with bench.visitor() as other, contextlib.ExitStack() as left:
        puller = left.enter_context(bench.visitor())
        bench.pull(puller, 12.0)
        bench.wait_for_tension(12.0)
        left.close()
        bench.wait_for_tension(0.0)
        bench.wait_for_silence(bench.tensions)
        bench.pull(other, 5.0)
        bench.wait_for_tension(5.0)


@pytest.mark.parametrize(
    ("topic", "label", "taken", "back"),
    [
        ("/cable_tension_cmd", TAKE, True, False),
        ("/traj_pose", LEAD, "the target", "nothing"),
        ("/joint_states", LEAD, "the joints", "nothing"),
    ],
)
def test_a_topic_is_advertised_while_somebody_speaks_by_it(bench, topic, label, taken, back):
    bench.wait(lambda: bench.probe.count("viewer", "received cable_states") > 0, "tensions heard")
    bench.probe.wait_for_report("viewer")
    with bench.visitor() as visitor:
        for _ in range(2):
            assert not bench.advertises(topic)
            visitor.put(label, taken)
            bench.wait(lambda: bench.advertises(topic), "advertised")
            visitor.put(label, back)
            bench.wait(lambda: not bench.advertises(topic), "withdrawn")


def test_nobody_is_talked_over(bench):
    """Another's tensions hold while it speaks; then those of the page."""
    say = bench.probe.speaker(CableStates, "cable_tension_cmd").publish
    with bench.visitor() as visitor:
        bench.pull(visitor, 12.0)
        bench.wait_for_tension(12.0)
        bench.wait_until_silent("cable_tension_cmd", lambda: say(cables(1, 0, CABLES, [0.1, 0.1])))
        assert not bench.advertises("/cable_tension_cmd")
        received = len(bench.tensions)
        bench.wait(lambda: any(len(one.effort) for one in bench.tensions[received:]), "the viewer's voice again")


def test_a_dragged_target_and_joints_are_published(bench):
    place = arm_pose(postures(1)[0][0] * 0.3, ARM)[:3, 3]
    with bench.visitor() as visitor:
        visitor.put(LEAD, "the target")
        bench.wait(lambda: bench.targets, "a target")
        visitor.drag(place)

        def there():
            point = bench.targets[-1].pose.position
            return np.allclose([point.x, point.y, point.z], place)

        bench.wait(there, "the target where it was dragged")
        assert bench.targets[-1].header.frame_id == "base_link"
        assert bench.joints == []
        visitor.put(LEAD, "the joints")
        visitor.put("theta [deg]", 40.0)

        def bent():
            if not bench.joints:
                return False
            w = configuration_of_joints(dict(zip(bench.joints[-1].name, bench.joints[-1].position, strict=True)), ARM)
            return np.isclose(np.hypot(*w[0]), np.radians(40.0))

        bench.wait(bent, "the joint states")
    bench.wait_for_silence(bench.joints)
    bench.wait_for_silence(bench.targets)


@pytest.fixture
def fresh():
    """A viewer that has heard nothing yet."""
    with domain_id() as domain, started(domain) as bench:
        yield bench


def test_what_nodes_say_is_to_be_seen(fresh):
    """A simulated arm makes the measured one its ghost; who falls silent is told to be silent."""
    bench = fresh
    say = [bench.probe.speaker(JointState, topic).publish for topic in ("joint_states", "simulated/joint_states")]
    aim = bench.probe.speaker(PoseStamped, "traj_pose").publish
    tell = bench.probe.speaker(DiagnosticArray, "/diagnostics", listeners=2, qos=REPORT).publish
    tell(DiagnosticArray(status=[DiagnosticStatus(name="imu 3", message="well and good")]))
    with bench.visitor() as visitor:

        def seen(*names):
            for publish, w in zip(say, postures(2)[0], strict=True):
                publish(joint_state(1, w))
            return visitor.shown.issuperset(names)

        def words():
            return " ".join(visitor.texts.values())

        bench.wait(lambda: seen("/ghost"), "the ghost")
        assert "/wanted" not in visitor.shown
        bench.wait(lambda: (aim(pose(1, (0.1, 0.0, 0.2))), seen("/wanted"))[1], "the target")
        bench.wait(lambda: "imu 3" in words() and "silent" in words(), words)


def test_joints_that_a_node_moves_are_left_to_it(bench):
    """Not asked: that never a word is said. A node that was silent for long, on a busy machine, may be spoken for."""
    publish, w = bench.probe.speaker(JointState, "joint_states").publish, postures(1)[0][0]

    def say():
        publish(joint_state(1, w))

    with bench.visitor() as visitor:
        visitor.put(LEAD, "the joints")
        bench.wait(lambda: bench.joints, "the page's joints")
        bench.wait_until_silent("joint_states", say)
        bench.wait(lambda: (say(), "joint_states" in bench.probe.report("viewer").get("message", ""))[1], "told")


def test_who_and_what_is_refused_is_on_diagnostics_and_the_viewer_lives(bench):
    with pytest.raises(InvalidStatus, match="403"):
        Visitor(bench.address, "http://evil.example")
    bench.wait(lambda: bench.probe.count("viewer", "dropped: page of another site") == 1, "a page of another site")
    with bench.visitor() as visitor:
        for _ in range(20):
            visitor.put("Section", "section_99")
        visitor.drag((0.1, 0.2))
        bench.wait(lambda: bench.probe.count("viewer", "dropped: message of a browser") == 21, "messages dropped")
        visitor.put(LEAD, "the target")
        bench.wait(lambda: bench.targets, "a target")
    assert len([line for line in bench.node.stderr.splitlines() if "message of a browser" in line]) < 10


def test_what_is_drawn_no_more_ends_the_node(domain):
    rclpy.init(domain_id=domain, args=["--ros-args", "-p", "port:=0"])
    node = ViewerNode()
    try:
        node._stop.set()
        node._drawing.join()
        with pytest.raises(NotDrawnError):
            node._act()
    finally:
        node.close()
        node.destroy_node()
        rclpy.shutdown()
