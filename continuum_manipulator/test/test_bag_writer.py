"""Recordings: read back by rosbags' own reader, hashes of types as rosidl makes them, what a killed recorder leaves."""

import shutil

import pytest
import yaml
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.serialization import serialize_message
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from sensor_msgs.msg import JointState

from continuum.errors import FileError, InvalidValueError
from continuum_manipulator.bag_qos import heard_by_all, offered
from continuum_manipulator.bag_recovery import recover
from continuum_manipulator.bag_writer import BagWriter
from continuum_manipulator.message_definitions import message_definition
from continuum_manipulator.nodekit.qos import STREAM

TYPE = "sensor_msgs/msg/JointState"
RAW = serialize_message(JointState(name=["a"], position=[1.5]))


def write(bag, n, first=0):
    handle = bag.add_topic("/joint_states", TYPE, [offered(STREAM)])
    for i in range(first, first + n):
        bag.write(handle, RAW, 1_000 + i)
    return handle


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_reader_finds_what_was_written(tmp_path, storage):
    with BagWriter(tmp_path / "bag", storage) as bag:
        write(bag, 5)
    with Reader(tmp_path / "bag") as reader:
        (connection,) = reader.connections
        assert (connection.topic, connection.msgtype, connection.msgcount) == ("/joint_states", TYPE, 5)
        assert connection.ext.offered_qos_profiles == [offered(STREAM)]
        messages = [(stamp, raw) for _, stamp, raw in reader.messages()]
    assert messages == [(1_000 + i, RAW) for i in range(5)]
    metadata = yaml.safe_load((tmp_path / "bag" / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    (topic,) = metadata["topics_with_message_count"]
    assert metadata["version"] == 9
    assert metadata["storage_identifier"] == storage
    assert topic["topic_metadata"]["offered_qos_profiles"][0]["reliability"] == "reliable"


@pytest.mark.parametrize("message_type", [TYPE, "geometry_msgs/msg/TwistStamped", "visualization_msgs/msg/MarkerArray"])
def test_definition_and_hash_are_those_of_rosidl(message_type):
    definition, type_hash = message_definition(message_type)
    store = get_typestore(Stores.EMPTY)
    root, *inner = definition.split("=" * 80 + "\n")
    store.register(get_types_from_msg(root, message_type))
    for text in inner:
        name, _, body = text.removeprefix("MSG: ").partition("\n")
        store.register(get_types_from_msg(body, name.replace("/", "/msg/")))
    assert store.hash_rihs01(message_type) == type_hash == get_typestore(Stores.ROS2_JAZZY).hash_rihs01(message_type)


def test_unknown_type_is_named():
    with pytest.raises(FileError, match="no_such_package/msg/Thing"):
        message_definition("no_such_package/msg/Thing")


def test_existing_folder_is_not_overwritten(tmp_path):
    with pytest.raises(FileError, match="exists already"):
        BagWriter(tmp_path)


def test_unknown_storage_is_refused(tmp_path):
    with pytest.raises(InvalidValueError, match="mcap, sqlite3"):
        BagWriter(tmp_path / "bag", "tape")


@pytest.mark.parametrize("cut", [0, 1, 7, 100])
def test_flushed_messages_survive_a_kill_at_any_byte(tmp_path, cut):
    with BagWriter(tmp_path / "bag") as bag:
        handle = write(bag, 20)
        bag.flush()
        bag.write(handle, RAW, 1_020)
        bag.flush()
        write_more = bag.add_topic("/more", TYPE, [])
        bag.write(write_more, RAW, 5_000)
        left = shutil.copytree(tmp_path / "bag", tmp_path / "left")
    (file,) = left.glob("*.mcap")
    whole = file.read_bytes()
    file.write_bytes(whole + (tmp_path / "bag" / "bag.mcap").read_bytes()[len(whole) : len(whole) + cut])
    assert recover(left, tmp_path / "recovered") == 21
    with Reader(tmp_path / "recovered") as reader:
        assert [(c.topic, c.msgcount) for c in reader.connections] == [("/joint_states", 21)]
        assert reader.connections[0].ext.offered_qos_profiles == [offered(STREAM)]
        assert [(stamp, raw) for _, stamp, raw in reader.messages()] == [(1_000 + i, RAW) for i in range(21)]


def test_recovery_of_nothing(tmp_path):
    with pytest.raises(FileError, match="holds no MCAP file"):
        recover(tmp_path, tmp_path / "recovered")


def test_request_is_met_by_every_publisher():
    assert heard_by_all([]).reliability == STREAM.reliability
    assert heard_by_all([STREAM]).reliability == STREAM.reliability
    assert heard_by_all([STREAM, qos_profile_sensor_data]).reliability == qos_profile_sensor_data.reliability
    kept = QoSProfile(depth=1, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL)
    assert heard_by_all([kept, STREAM]).durability == STREAM.durability
    assert heard_by_all([kept]).durability == kept.durability
