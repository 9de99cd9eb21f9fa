"""Recordings: read back by rosbags' own reader, hashes of types as rosidl makes them, what a killed recorder leaves."""

import shlex
import shutil
import subprocess
import sys

import pytest
import yaml
from mcap.writer import CompressionType, Writer
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.serialization import serialize_message
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from sensor_msgs.msg import JointState

from continuum.errors import FileError, InvalidValueError
from continuum.recordings.bag import Bag
from continuum_manipulator.bag_qos import offered, received_by_all
from continuum_manipulator.bag_recovery import Recovered, recover
from continuum_manipulator.bag_writer import BagWriter
from continuum_manipulator.message_definitions import message_definition
from continuum_manipulator.nodekit.qos import STREAM

TYPE = "sensor_msgs/msg/JointState"
RAW = serialize_message(JointState(name=["a"], position=[1.5], velocity=[0.5], effort=[2.0]))


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
    assert recover(left, tmp_path / "recovered") == Recovered(21, 0)
    with Reader(tmp_path / "recovered") as reader:
        assert [(c.topic, c.msgcount) for c in reader.connections] == [("/joint_states", 21)]
        assert reader.connections[0].ext.offered_qos_profiles == [offered(STREAM)]
        assert [(stamp, raw) for _, stamp, raw in reader.messages()] == [(1_000 + i, RAW) for i in range(21)]


def bag_of_chunks(folder):
    """Three chunks of 10 messages."""
    with BagWriter(folder) as bag:
        handle = bag.add_topic("/joint_states", TYPE, [offered(STREAM)])
        for stamp in range(30):
            bag.write(handle, RAW, 1_000 + stamp)
            if stamp % 10 == 9:
                bag.flush()
    (file,) = folder.glob("*.mcap")
    return file


@pytest.mark.parametrize("metadata", [True, False])
def test_refusal_of_a_damaged_recording_says_how_the_rest_is_had(tmp_path, metadata):
    broken = tmp_path / "broken bag"
    file = bag_of_chunks(broken)
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    if not metadata:
        (broken / "metadata.yaml").unlink()
    for path in (broken, file):
        with pytest.raises(FileError, match="bag_recovery") as refusal, Bag(path) as bag:
            list(bag.messages("/joint_states", TYPE))
        _, *command = shlex.split(str(refusal.value)[str(refusal.value).index("python3 -m") :])
        command[-1] = str(tmp_path / f"recovered_{path.name}")
        done = subprocess.run([sys.executable, *command], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        with Bag(command[-1]) as bag:
            assert 10 <= len(list(bag.messages("/joint_states", TYPE))) < 30


def test_what_is_no_mcap_recording_is_not_sent_to_a_recovery(tmp_path):
    for path in (tmp_path, tmp_path / "none"):
        with pytest.raises(FileError) as refusal:
            Bag(path)
        assert "bag_recovery" not in str(refusal.value)


def test_a_changed_byte_ends_no_recovery_without_a_word(tmp_path):
    file = bag_of_chunks(tmp_path / "bag")
    whole = file.read_bytes()
    for number, at in enumerate(range(8, len(whole), 293)):
        file.write_bytes(whole[:at] + bytes([whole[at] ^ 0x5A]) + whole[at + 1 :])
        folder = tmp_path / f"recovered_{number}"
        try:
            found = recover(file, folder)
        except FileError:  # what was changed says that it is compressed, or is the name of a type
            continue
        if not found.messages:
            continue
        with Reader(folder) as reader:
            assert len(list(reader.messages())) == found.messages <= 30


@pytest.mark.parametrize("compression", [CompressionType.LZ4, CompressionType.ZSTD])
def test_chunks_of_a_compressed_recording_survive_a_cut(tmp_path, compression):
    file = tmp_path / "bag.mcap"
    with file.open("wb") as stream:
        writer = Writer(stream, chunk_size=10 * len(RAW), compression=compression)
        writer.start()
        schema = writer.register_schema(TYPE, "ros2msg", b"")
        channel = writer.register_channel("/joint_states", "cdr", schema)
        for stamp in range(60):
            writer.add_message(channel, log_time=stamp, publish_time=stamp, data=RAW)
        writer.finish()
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    found = recover(file, tmp_path / "recovered")
    assert 10 <= found.messages < 60
    with Reader(tmp_path / "recovered") as reader:
        assert [(stamp, raw) for _, stamp, raw in reader.messages()] == [(i, RAW) for i in range(found.messages)]


def test_files_of_a_split_recording_are_joined(tmp_path):
    for number in range(2):
        file = bag_of_chunks(tmp_path / f"part_{number}")
        (tmp_path / "split").mkdir(exist_ok=True)
        shutil.copy(file, tmp_path / "split" / f"{number}.mcap")
    assert recover(tmp_path / "split", tmp_path / "recovered") == Recovered(60, 0)


def test_recovery_of_nothing(tmp_path):
    with pytest.raises(FileError, match="contains no MCAP file"):
        recover(tmp_path, tmp_path / "recovered")


def test_request_is_met_by_every_publisher():
    assert received_by_all([]).reliability == STREAM.reliability
    assert received_by_all([STREAM]).reliability == STREAM.reliability
    assert received_by_all([STREAM, qos_profile_sensor_data]).reliability == qos_profile_sensor_data.reliability
    kept = QoSProfile(depth=1, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL)
    assert received_by_all([kept, STREAM]).durability == STREAM.durability
    assert received_by_all([kept]).durability == kept.durability


def test_records_behind_a_wrong_length_of_a_finished_file_are_counted_as_damage(tmp_path):
    file = bag_of_chunks(tmp_path / "bag")
    data = bytearray(file.read_bytes())
    data[8 + 1 + 7] = 1  # the highest byte of the first record's length
    file.write_bytes(data)
    assert recover(file, tmp_path / "recovered") == Recovered(0, 1)
