"""The recorder over DDS: nothing that was sent is lost, whichever signal ends it, and rosbags reads what it left."""

import resource
import signal

import pytest
from arm_messages import cables, joint_state, postures
from harness import NodeProcess, Probe, ended_in_any_case
from rclpy.qos import qos_profile_sensor_data
from rosbags.interfaces import QosReliability
from rosbags.rosbag2 import Reader
from sensor_msgs.msg import JointState

from continuum_manipulator.bag_recovery import recover
from continuum_manipulator.message_definitions import message_definition
from continuum_msgs.msg import CableStates

pytestmark = pytest.mark.ros

N = 300


@pytest.fixture(scope="module")
def probe(domain):
    with Probe(domain) as probe:
        yield probe


def recorder(domain, folder, **parameters) -> NodeProcess:
    return NodeProcess("continuum_manipulator", "recorder", domain, parameters={"output": folder, **parameters})


def contents(folder) -> dict[str, int]:
    with Reader(folder) as reader:
        for connection in reader.connections:
            assert connection.msgdef.data == message_definition(connection.msgtype)[0]
            assert connection.digest == message_definition(connection.msgtype)[1]
        return {connection.topic: connection.msgcount for connection in reader.connections}


@pytest.mark.parametrize(("number", "storage"), [(signal.SIGINT, "mcap"), (signal.SIGTERM, "sqlite3")])
def test_all_topics_also_later_ones_to_the_last_message(domain, probe, tmp_path, number, storage):
    joints = probe.node.create_publisher(JointState, "joint_states", qos_profile_sensor_data)
    node = recorder(domain, tmp_path / "bag", storage=storage)
    with ended_in_any_case(node):
        node.wait_for_line("recording ")
        late = probe.speaker(CableStates, "cable_states")
        probe.wait_until(lambda: joints.get_subscription_count(), "the recorder on joint_states")
        w, _ = postures(1)
        for i in range(N):
            late.publish(cables(i, 0, ["a"], [0.1]))
            joints.publish(joint_state(i, w[0]))
        late.wait_for_all_acked()
        assert node.stop(number) == 0
        errors = node.stderr
    probe.node.destroy_publisher(joints)
    probe.node.destroy_publisher(late)
    counts = contents(tmp_path / "bag")
    assert counts["/cable_states"] == N
    assert 0 < counts["/joint_states"] <= N  # offered without retries
    assert "Traceback" not in errors
    assert f"{N}  /cable_states" in errors
    with Reader(tmp_path / "bag") as reader:
        offers = {c.topic: [q.reliability for q in c.ext.offered_qos_profiles] for c in reader.connections}
    assert offers["/cable_states"] == [QosReliability.RELIABLE]
    assert offers["/joint_states"] == [QosReliability.BEST_EFFORT]


def test_only_the_topics_asked_for_and_publishers_that_offer_less(domain, probe, tmp_path):
    """A topic is subscribed to before its publisher is there, and again when that turns out to be best effort."""
    probe.node.create_subscription(JointState, "wanted", lambda _: None, qos_profile_sensor_data)
    other = probe.node.create_publisher(JointState, "not_wanted", 10)
    node = recorder(domain, tmp_path / "bag", topics="[wanted]")
    with ended_in_any_case(node):
        node.wait_for_line("recording 1 topics")
        wanted = probe.speaker(JointState, "wanted", listeners=2, qos=qos_profile_sensor_data)
        w, _ = postures(1)
        other.publish(joint_state(0, w[0]))
        probe.wait_until(
            lambda: (wanted.publish(joint_state(0, w[0])), probe.count("recorder", "received /wanted"))[1],
            "a message on the recorder's diagnostics",
        )
        assert node.stop() == 0
    probe.node.destroy_publisher(wanted)
    probe.node.destroy_publisher(other)
    assert list(contents(tmp_path / "bag")) == ["/wanted"]


def test_a_topic_that_never_comes_is_reported_at_the_start_and_at_the_end(domain, tmp_path):
    node = recorder(domain, tmp_path / "bag", topics="[nope]")
    with ended_in_any_case(node):
        node.wait_for_line("waiting for /nope")
        assert node.stop() == 0
        errors = node.stderr
    assert "recorded 0 messages of 0 topics" in errors
    assert "0  /nope" in errors


def test_a_killed_recorder_leaves_what_was_flushed(domain, probe, tmp_path):
    node = recorder(domain, tmp_path / "bag", topics="[cable_states]", flush_period=0.05)
    with ended_in_any_case(node):
        states = probe.speaker(CableStates, "cable_states", listeners=0)
        probe.wait_until(lambda: states.get_subscription_count(), "the recorder")
        for i in range(N):
            states.publish(cables(i, 0, ["a"], [0.1]))
        states.wait_for_all_acked()
        probe.wait_until(
            lambda: probe.count("recorder", "received /cable_states") == N, lambda: probe.report("recorder")
        )
        size = file_size(tmp_path / "bag")
        states.publish(cables(N, 0, ["a"], [0.1]))
        probe.wait_until(lambda: file_size(tmp_path / "bag") > size, "the next flush")
        node.stop(signal.SIGKILL)
    probe.node.destroy_publisher(states)
    assert recover(tmp_path / "bag", tmp_path / "recovered").messages == N + 1
    assert contents(tmp_path / "recovered") == {"/cable_states": N + 1}


def test_a_full_disk_is_reported_in_one_line_that_names_the_remedy(domain, probe, tmp_path):
    node = recorder(domain, tmp_path / "bag", topics="[cable_states]", flush_period=0.05)
    with ended_in_any_case(node):
        node.wait_for_line("waiting for")
        resource.prlimit(node.process.pid, resource.RLIMIT_FSIZE, (4096, 4096))
        states = probe.speaker(CableStates, "cable_states")
        probe.wait_until(lambda: (states.publish(cables(0, 0, ["a"] * 20, [0.1] * 20)), not node.running)[1], "its end")
        assert node.exit_code() == 1
        errors = node.stderr
    probe.node.destroy_publisher(states)
    assert errors.count("recorder: error:") == 1
    assert "continuum_manipulator.bag_recovery" in errors
    assert "Traceback" not in errors


def test_publishers_stopped_with_the_recorder_are_recorded(domain, probe, tmp_path):
    node = recorder(domain, tmp_path / "bag", topics="[]")
    with ended_in_any_case(node):
        states = probe.speaker(CableStates, "cable_states")
        probe.wait_for_report("recorder")
        probe.wait_until(
            lambda: (states.publish(cables(0, 0, ["a"], [0.1])), probe.count("recorder", "received /cable_states"))[1],
            "a first message",
        )
        states.wait_for_all_acked()
        node.send(signal.SIGINT)
        for _ in range(20):
            states.publish(cables(0, 0, ["last"], [0.1]))
            probe.listen_until_quiet(0.05)
        assert node.exit_code() == 0
    probe.node.destroy_publisher(states)
    with Reader(tmp_path / "bag") as reader:
        texts = [raw for connection, _, raw in reader.messages() if connection.topic == "/cable_states"]
    assert sum(b"last" in raw for raw in texts) == 20


def file_size(folder) -> int:
    (file,) = folder.glob("*.mcap")
    return file.stat().st_size
