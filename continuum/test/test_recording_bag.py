"""Recordings from rosbag2: what the node `dynamics` publishes comes back as a run."""

import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from recorded_runs import START, TYPES, Topics, message, write
from recorded_runs import run as kinematic_run
from rosbags.rosbag2 import StoragePlugin
from swing_bag import ANGLES, JOINTS, PULL, RATES, ROWS, STAMPS, T, stamped, swing

from continuum.errors import FileError
from continuum.recordings.read_recording import read_recording
from continuum.recordings.recording_bag import read_recording_bag
from continuum.viewer.tracks import read_tracks


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
def test_without_tensions_the_cables_are_slack_which_is_reported(
    tmp_path: Path, change: Callable[[Topics], None]
) -> None:
    topics = swing()
    change(topics)
    found = read_recording_bag(write(tmp_path / "swing", topics))
    assert (found.is_driven, found.notes) == (False, ("no efforts on /cable_states: cables assumed slack",))


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


def tensions_end_early(topics: Topics) -> None:
    del topics["/cable_states"][45:]


def two_clocks(topics: Topics) -> None:
    for one in topics["/cable_states"]:
        stamped(one, START - 10**12)


def without_stamps(topics: Topics) -> None:
    for one in topics["/joint_states"]:
        stamped(one, 0)


def silent(topics: Topics) -> None:
    topics["/joint_states"].clear()


@pytest.mark.parametrize(
    ("change", "output"),
    [
        (other_name, "holds no section_1_theta_2"),
        (other_cable, "holds no section_1_cable_1"),
        (no_bending_joint, "has the joints a, b, c, d, e on /joint_states; .*one section that bends in a plane"),
        (turned, "turns its plane by section_1_phi"),
        (tensions_end_early, r"has 3\d bad messages of 90; .*: messages 5\d, .*\.\. without a finite value"),
        (two_clocks, "has no message on /cable_states within 0.1 s"),
        (without_stamps, "has no message on /joint_states with a stamp"),
        (silent, "has no message on /joint_states"),
    ],
)
def test_what_cannot_be_repaired_is_refused(tmp_path: Path, change: Callable[[Topics], None], output: str) -> None:
    topics = swing()
    change(topics)
    with pytest.raises(FileError, match=f"swing: .*{output}"):
        read_recording_bag(write(tmp_path / "swing", topics))


def test_an_arm_of_two_sections_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"on /joint_states, of the sections section_2, section_1"):
        read_recording_bag(write(tmp_path / "run", kinematic_run()))


@pytest.mark.parametrize(("first", "by", "shift"), [(45, 45, 0), (45, 6, 3_000_000), (30, 12, 0)])
def test_a_clock_that_steps_back_is_refused(tmp_path: Path, first: int, by: int, shift: int) -> None:
    """Two runs in one bag, and a clock that was set back; its stamps may be the earlier ones or between these."""
    topics = swing()
    stamps = np.concatenate([STAMPS[:first], STAMPS[first - by : ROWS - by] + shift])
    for messages in topics.values():
        for one, stamp in zip(messages, stamps, strict=True):
            one.header.stamp.sec, one.header.stamp.nanosec = divmod(int(stamp), 10**9)
    folder = write(tmp_path / "swing", topics)
    for reader in (read_recording_bag, read_tracks):
        with pytest.raises(FileError, match=f"message {first + 1} .*backward"):
            reader(folder)


@pytest.mark.parametrize("places", [[0], list(range(0, 180, 2))])
def test_others_on_the_topic_are_left_out_and_counted(tmp_path: Path, places: list[int]) -> None:
    topics = swing()
    for place in places:
        gripper = message(TYPES["/joint_states"], STAMPS[0], name=["gripper"], position=np.ones(1), velocity=np.ones(1))
        topics["/joint_states"].insert(place, gripper)
    found = read_recording_bag(write(tmp_path / "swing", topics))
    np.testing.assert_array_equal(found.theta, ANGLES)
    assert [note for note in found.notes if "gripper" in note and str(len(places)) in note]


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
