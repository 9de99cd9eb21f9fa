"""Bags of several publishers, clocks or forms of storage: what diagnose and view make of them."""

from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest
from recorded_runs import ARM, START, TYPES, joint_state, message, postures, typestore, write
from recorded_runs import STAMPS as RUN_STAMPS
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from swing_bag import ANGLES, PULL, RATES, STAMPS, stamped, swing

from continuum.errors import FileError
from continuum.recordings.read_recording import read_recording
from continuum.recordings.recording_bag import read_recording_bag
from continuum.viewer.tracks import read_tracks


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
        with pytest.raises(FileError, match="jump back and forth"):
            reader(folder)


def test_others_among_the_cables_are_left_out_and_counted(tmp_path: Path) -> None:
    topics = swing()
    winch = message(TYPES["/cable_states"], STAMPS[0], name=["winch"], position=np.ones(1), effort=np.ones(1))
    topics["/cable_states"].insert(0, winch)
    folder = write(tmp_path / "swing", topics)
    found = read_recording_bag(folder)
    np.testing.assert_allclose(found.pull.values, PULL, rtol=0, atol=1e-12)
    note = "1 message of other publishers on /cable_states (winch), left out"
    assert found.notes == read_tracks(folder).notes == (note,)


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


def sections_apart(whole: list) -> list[list]:
    """Messages of a node for each section."""
    return [
        [
            message(TYPES["/joint_states"], stamp, name=[one.name[k] for k in mine], position=one.position[mine])
            for one, stamp in zip(whole, RUN_STAMPS, strict=True)
            for mine in [[k for k, name in enumerate(one.name) if name.startswith(section.name)]]
        ]
        for section in ARM.sections
    ]


@pytest.mark.parametrize("order", ["in turn", "one after the other", "at random", "one ends early"])
def test_sections_that_publish_their_joints_each_are_one_arm(tmp_path: Path, order: str) -> None:
    """As in the mode of the launch file in which cables move the arm: whatever the order in which messages arrive."""
    whole = [joint_state(stamp, w) for stamp, w in zip(RUN_STAMPS, postures()[0], strict=True)]
    parts = sections_apart(whole)
    arriving = [part for parts_of_one in zip(*parts, strict=True) for part in parts_of_one]
    if order == "one after the other":
        arriving = [part for messages in parts for part in messages]
    if order == "at random":
        turns = np.random.default_rng(0).permutation(np.repeat(range(len(parts)), len(whole)))
        queues = [iter(messages) for messages in parts]
        arriving = [next(queues[k]) for k in turns]
    if order == "one ends early":
        arriving, whole = [one for one in arriving if one not in parts[1][-20:]], whole[:-20]
    expected = read_tracks(write(tmp_path / "whole", {"/joint_states": whole})).joints
    tracks = read_tracks(write(tmp_path / "parts", {"/joint_states": arriving}))
    found = tracks.joints
    np.testing.assert_array_equal(found.times, expected.times)
    places = [found.names.index(name) for name in expected.names]
    np.testing.assert_array_equal(found.values[:, places], expected.values)
    assert any("20 messages of single sections" in note for note in tracks.notes) == (order == "one ends early")


def test_sections_without_a_common_stamp_are_refused(tmp_path: Path) -> None:
    parts = sections_apart([joint_state(stamp, w) for stamp, w in zip(RUN_STAMPS, postures()[0], strict=True)])
    for one, stamp in zip(parts[1], RUN_STAMPS, strict=True):
        stamped(one, stamp + 200_000)
    arriving = [part for parts_of_one in zip(*parts, strict=True) for part in parts_of_one]
    with pytest.raises(FileError, match="0 of which have a stamp that all 2 sections share"):
        read_tracks(write(tmp_path / "parts", {"/joint_states": arriving}))
