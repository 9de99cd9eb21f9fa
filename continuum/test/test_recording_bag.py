"""Recordings from rosbag2: what the node `dynamics` publishes comes back as a run."""

import sqlite3
from collections.abc import Callable
from contextlib import closing
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from recorded_runs import START, TYPES, Topics, message, typestore, write
from recorded_runs import run as kinematic_run
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

from continuum.cli.diagnose import read_recording
from continuum.errors import FileError
from continuum.recordings.recording_bag import read_recording_bag
from continuum.viewer.tracks import read_tracks

ROWS, JOINTS = 90, 3
T = np.arange(ROWS) / 120
STAMPS = START + np.round(T * 1e9).astype(np.int64)
PHASES = np.arange(JOINTS)
ANGLES, RATES = 0.3 * np.cos(6 * T[:, None] + PHASES), -1.8 * np.sin(6 * T[:, None] + PHASES)
PULL = np.stack([4 - 3 * np.sin(5 * T), 4 + 3 * np.sin(5 * T)], axis=1)
JOINT_NAMES = ["section_1_phi", *(f"section_1_theta_{j + 1}" for j in range(JOINTS)), "section_1_phi_back"]
CABLE_NAMES = ["section_1_cable_1", "section_1_cable_2"]


def swing() -> Topics:
    """Three joints that sway and two cables, as the node publishes them."""
    topics: Topics = {"/joint_states": [], "/cable_states": []}
    for stamp, angles, rates, pull in zip(STAMPS, ANGLES, RATES, PULL, strict=True):
        topics["/joint_states"].append(
            message(
                TYPES["/joint_states"],
                stamp,
                name=list(JOINT_NAMES),
                position=np.concatenate([[0.0], angles, [0.0]]),
                velocity=np.concatenate([[0.0], rates, [0.0]]),
            )
        )
        topics["/cable_states"].append(
            message(TYPES["/cable_states"], stamp, name=list(CABLE_NAMES), position=np.ones(2), effort=pull)
        )
    return topics


def backwards(topics: Topics) -> None:
    """Every list of names and values the other way round."""
    for one in topics["/joint_states"]:
        one.name, one.position, one.velocity = one.name[::-1], one.position[::-1].copy(), one.velocity[::-1].copy()
    for one in topics["/cable_states"]:
        one.name, one.position, one.effort = one.name[::-1], one.position[::-1].copy(), one.effort[::-1].copy()


def shuffled(topics: Topics) -> None:
    """Messages in the order in which a network may deliver them."""
    for messages in topics.values():
        messages[10], messages[13] = messages[13], messages[10]


@pytest.mark.parametrize("change", [lambda topics: None, backwards, shuffled], ids=["as sent", "names", "arrival"])
def test_what_was_published_is_read(tmp_path: Path, change: Callable[[Topics], None]) -> None:
    topics = swing()
    change(topics)
    found = read_recording_bag(write(tmp_path / "swing 7", topics))
    assert (found.name, found.notes, found.is_driven) == ("swing 7", (), True)
    np.testing.assert_allclose(found.times, T, rtol=0, atol=1e-8)
    np.testing.assert_array_equal(found.theta, ANGLES)
    np.testing.assert_array_equal(found.theta_rate, RATES)
    np.testing.assert_allclose(found.pull.values, PULL, rtol=0, atol=1e-12)


def test_the_command_takes_folders_and_files(tmp_path: Path) -> None:
    assert read_recording(str(write(tmp_path / "swing", swing()))).n_joints == JOINTS
    table = tmp_path / "swing.csv"
    table.write_text("t_s,q1_rad\n" + "".join(f"{t},{q}\n" for t, q in zip(T, ANGLES[:, 0], strict=True)))
    assert read_recording(str(table)).n_joints == 1


def no_cables(topics: Topics) -> None:
    del topics["/cable_states"]


def no_efforts(topics: Topics) -> None:
    for one in topics["/cable_states"]:
        one.effort = np.zeros(0)


@pytest.mark.parametrize("change", [no_cables, no_efforts])
def test_without_tensions_the_cables_are_slack_which_is_told(tmp_path: Path, change: Callable[[Topics], None]) -> None:
    topics = swing()
    change(topics)
    found = read_recording_bag(write(tmp_path / "swing", topics))
    assert (found.is_driven, found.notes) == (False, ("no efforts on /cable_states: cables taken as slack",))


def test_without_rates(tmp_path: Path) -> None:
    topics = swing()
    for one in topics["/joint_states"]:
        one.velocity = np.zeros(0)
    assert read_recording_bag(write(tmp_path / "swing", topics)).theta_rate is None


def test_lost_and_repeated_messages(tmp_path: Path) -> None:
    topics = swing()
    topics["/joint_states"].insert(20, topics["/joint_states"][19])
    del topics["/joint_states"][40], topics["/cable_states"][60:63]
    found = read_recording_bag(write(tmp_path / "swing", topics))
    assert found.notes == ("message 21 with the time of the message before, left out",)
    np.testing.assert_array_equal(found.theta, np.delete(ANGLES, 39, axis=0))
    np.testing.assert_allclose(found.pull.values, np.delete(PULL, 39, axis=0), rtol=0, atol=0.02)


def other_name(topics: Topics) -> None:
    topics["/joint_states"][50].name[2] = "elbow"


def other_cable(topics: Topics) -> None:
    topics["/cable_states"][50].name[0] = "section_1_cable_9"


def no_bending_joint(topics: Topics) -> None:
    for one in topics["/joint_states"]:
        one.name = ["a", "b", "c", "d", "e"]


def turned(topics: Topics) -> None:
    for one in topics["/joint_states"]:
        one.position[0] = 1.0
    topics["/joint_states"][3].position[0] = np.nan


def pushing(topics: Topics) -> None:
    topics["/cable_states"][50].effort = np.array([1.0, -2.0])


def tensions_end_early(topics: Topics) -> None:
    del topics["/cable_states"][45:]


def stamped(one: Any, stamp: int) -> None:
    one.header.stamp.sec, one.header.stamp.nanosec = divmod(int(stamp), 10**9)


def two_clocks(topics: Topics) -> None:
    for one in topics["/cable_states"]:
        stamped(one, START - 10**12)


def without_stamps(topics: Topics) -> None:
    for one in topics["/joint_states"]:
        stamped(one, 0)


def in_two_parts(topics: Topics) -> None:
    del topics["/joint_states"][30:65]


def silent(topics: Topics) -> None:
    topics["/joint_states"].clear()


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (other_name, "holds no section_1_theta_2"),
        (other_cable, "holds no section_1_cable_1"),
        (no_bending_joint, "has the sections none on /joint_states; one that bends in a plane"),
        (turned, "turns its plane by section_1_phi"),
        (pushing, "message 51: tension -2 N; a cable cannot push"),
        (tensions_end_early, r"has 3\d bad messages of 90; .*: messages 5\d, .*\.\. without a finite value"),
        (two_clocks, "has no message on /cable_states within 0.1 s"),
        (without_stamps, "has no message on /joint_states with a stamp"),
        (in_two_parts, "messages 30 to 31: a gap of 0.3 s"),
        (silent, "has no message on /joint_states"),
    ],
)
def test_what_cannot_be_repaired_is_refused(tmp_path: Path, change: Callable[[Topics], None], told: str) -> None:
    topics = swing()
    change(topics)
    with pytest.raises(FileError, match=f"swing: .*{told}"):
        read_recording_bag(write(tmp_path / "swing", topics))


def test_an_arm_of_two_sections_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="has the sections section_2, section_1 on /joint_states"):
        read_recording_bag(write(tmp_path / "run", kinematic_run()))


def test_no_recording(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="not a readable rosbag2 recording"):
        read_recording_bag(tmp_path)


@pytest.mark.parametrize(("first", "by", "shift"), [(45, 45, 0), (45, 6, 3_000_000), (30, 12, 0)])
def test_a_clock_that_steps_back_is_refused(tmp_path: Path, first: int, by: int, shift: int) -> None:
    """Two runs in one bag, and a clock that was set back; its stamps may be the earlier ones or between these."""
    topics = swing()
    stamps = np.concatenate([STAMPS[:first], STAMPS[first - by : ROWS - by] + shift])
    for messages in topics.values():
        for one, stamp in zip(messages, stamps, strict=True):
            one.header.stamp.sec, one.header.stamp.nanosec = divmod(int(stamp), 10**9)
    with pytest.raises(FileError, match=f"message {first + 1} .*backward"):
        read_recording_bag(write(tmp_path / "swing", topics))


@pytest.mark.parametrize("places", [[0], list(range(0, 180, 2))])
def test_others_on_the_topic_are_left_out_and_counted(tmp_path: Path, places: list[int]) -> None:
    topics = swing()
    for place in places:
        gripper = message(TYPES["/joint_states"], STAMPS[0], name=["gripper"], position=np.ones(1), velocity=np.ones(1))
        topics["/joint_states"].insert(place, gripper)
    found = read_recording_bag(write(tmp_path / "swing", topics))
    np.testing.assert_array_equal(found.theta, ANGLES)
    assert [note for note in found.notes if "gripper" in note and str(len(places)) in note]


def test_the_storage_file_is_the_recording(tmp_path: Path) -> None:
    folder = write(tmp_path / "swing", swing())
    (storage,) = (path for path in folder.iterdir() if path.suffix != ".yaml")
    np.testing.assert_array_equal(read_recording(str(storage)).theta, ANGLES)


@pytest.mark.parametrize("definition", ["", "this ; is no definition", "unknown_msgs/Other value"])
def test_topics_of_types_that_nobody_knows_may_be_there(tmp_path: Path, definition: str) -> None:
    folder = write(tmp_path / "swing", swing(), StoragePlugin.SQLITE3)
    (storage,) = folder.glob("*.db3")
    with closing(sqlite3.connect(storage)) as database, database:
        columns = "(id, name, type, serialization_format, offered_qos_profiles, type_description_hash)"
        database.execute(f"INSERT INTO topics {columns} VALUES (99, '/foo', 'my_msgs/msg/Foo', 'cdr', '', '')")
        database.execute(
            "INSERT INTO message_definitions (topic_type, encoding, encoded_message_definition, type_description_hash) "
            "VALUES ('my_msgs/msg/Foo', 'ros2msg', ?, '')",
            (definition,),
        )
        database.execute("INSERT INTO messages (topic_id, timestamp, data) VALUES (99, ?, x'0001')", (START,))
    np.testing.assert_array_equal(read_recording(str(storage)).theta, ANGLES)


@pytest.mark.parametrize("mode", [CompressionMode.FILE, CompressionMode.MESSAGE])
@pytest.mark.parametrize("storage", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_every_file_of_a_compressed_recording_is_the_recording(
    tmp_path: Path, storage: StoragePlugin, mode: CompressionMode
) -> None:
    store, topics = typestore(), swing()
    writer = Writer(tmp_path / "swing", version=9, storage_plugin=storage)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        for topic, messages in topics.items():
            place = writer.add_connection(topic, TYPES[topic], typestore=store)
            for k, one in enumerate(messages):
                writer.write(place, START + k, store.serialize_cdr(one, TYPES[topic]))
    files = list((tmp_path / "swing").iterdir())
    assert len(files) == 2
    for path in files:
        np.testing.assert_array_equal(read_recording(str(path)).theta, ANGLES)
        np.testing.assert_array_equal(read_tracks(path).joints.values[:, 1:-1], ANGLES)


@pytest.mark.parametrize("topic", ["/joint_states", "/cable_states"])
def test_messages_without_a_stamp_are_left_out_and_counted(tmp_path: Path, topic: str) -> None:
    topics = swing()
    for place in (0, 40):
        stamped(topics[topic][place], 0)
    folder = write(tmp_path / "swing", topics)
    left = {"/joint_states": (0, 40), "/cable_states": ()}[topic]
    found, shown = read_recording_bag(folder), read_tracks(folder)
    np.testing.assert_array_equal(found.theta, np.delete(ANGLES, left, axis=0))
    for notes in (found.notes, shown.notes):
        assert f"2 messages without a stamp on {topic}, left out" in notes
    assert shown.duration < 1


@pytest.mark.parametrize("every", [1, 3, 10])
@pytest.mark.parametrize("late", [0, 1_000_000])
def test_two_that_publish_one_arm_are_refused(tmp_path: Path, every: int, late: int) -> None:
    """An arm and its simulation, say, or a publisher of zeros."""
    topics = swing()
    for one, stamp in list(zip(topics["/joint_states"], STAMPS, strict=True))[1::every]:
        other = deepcopy(one)
        other.position = 0.0 * one.position
        stamped(other, stamp + late)
        topics["/joint_states"].insert(topics["/joint_states"].index(one) + 1, other)
    folder = write(tmp_path / "swing", topics)
    for reader in (read_recording_bag, read_tracks):
        with pytest.raises(FileError, match="jump there and back"):
            reader(folder)


def test_others_among_the_cables_are_left_out_and_counted(tmp_path: Path) -> None:
    topics = swing()
    winch = message(TYPES["/cable_states"], STAMPS[0], name=["winch"], position=np.ones(1), effort=np.ones(1))
    topics["/cable_states"].insert(0, winch)
    folder = write(tmp_path / "swing", topics)
    found = read_recording_bag(folder)
    np.testing.assert_allclose(found.pull.values, PULL, rtol=0, atol=1e-12)
    assert found.notes == read_tracks(folder).notes == ("1 message of others on /cable_states (winch), left out",)


def test_two_runs_that_begin_at_other_times_are_refused(tmp_path: Path) -> None:
    topics = swing()
    for messages in topics.values():
        again = deepcopy(messages)
        for one, stamp in zip(again, STAMPS, strict=True):
            stamped(one, stamp - 300_000_000)
        messages.extend(again)
    folder = write(tmp_path / "swing", topics)
    for reader in (read_recording_bag, read_tracks):
        with pytest.raises(FileError, match=f"message {ROWS + 1} .*backward"):
            reader(folder)


def test_degrees_are_not_shown_as_radians(tmp_path: Path) -> None:
    topics = swing()
    for one in topics["/joint_states"]:
        one.position = np.degrees(one.position)
    with pytest.raises(FileError, match="degrees taken for radians"):
        read_tracks(write(tmp_path / "swing", topics))


def test_a_message_without_rates_is_left_out_where_others_have_some(tmp_path: Path) -> None:
    topics = swing()
    topics["/joint_states"][7].velocity = np.zeros(0)
    found = read_recording_bag(write(tmp_path / "swing", topics))
    np.testing.assert_array_equal(found.theta_rate, np.delete(RATES, 7, axis=0))
    assert len(found.notes) == 1


def test_what_is_no_finite_number_is_left_out_row_by_row_and_velocities_where_none_is(tmp_path: Path) -> None:
    topics = swing()
    for one in topics["/joint_states"][10:13]:
        one.velocity = np.full(JOINTS + 2, np.nan)
    topics["/joint_states"][20].position[1] = np.inf
    some = read_recording_bag(write(tmp_path / "some", topics))
    assert (some.times.size, some.theta_rate.shape) == (ROWS - 4, (ROWS - 4, JOINTS))
    for one in topics["/joint_states"]:
        one.velocity = np.full(JOINTS + 2, np.nan)
    none = read_recording_bag(write(tmp_path / "none", topics))
    assert none.theta_rate is None
    assert none.times.size == ROWS - 1
    assert [note for note in none.notes if "rates left out" in note]
    np.testing.assert_array_equal(none.theta, np.delete(ANGLES, 20, axis=0))


def test_two_near_messages_may_arrive_swapped(tmp_path: Path) -> None:
    topics = swing()
    first, second = topics["/joint_states"][50:52]
    near = int(STAMPS[51]) - 1_000_000
    first.header.stamp.sec, first.header.stamp.nanosec = divmod(near, 10**9)
    topics["/joint_states"][50:52] = [second, first]
    np.testing.assert_array_equal(read_recording_bag(write(tmp_path / "swing", topics)).theta, ANGLES)
