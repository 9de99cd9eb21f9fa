"""Recordings that are not what they should be, and how they are refused."""

from pathlib import Path

import numpy as np
import pytest
from continuum_laws.outcomes import outcome
from hypothesis import given
from hypothesis import strategies as st
from recorded_runs import STAMPS, TYPES, Topics, point, read, run, write
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from continuum.errors import ContinuumError, FileError, InvalidValueError
from continuum.recordings.bag import Bag
from continuum.recordings.kinematic_report import report_on

pytestmark = pytest.mark.slow

N = len(STAMPS)


@pytest.mark.parametrize(
    "topic", ["/traj_pose", "/joint_states", "/ik_status", "/cable_states", "/section_cable_states"]
)
def test_a_missing_topic_is_named(tmp_path: Path, topic: str) -> None:
    topics = run()
    del topics[topic]
    with pytest.raises(FileError, match=f"recording: has no topic {topic}; it has .*/traj_twist"):
        read(write(tmp_path / "recording", topics))


def test_a_topic_of_another_type(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(TYPES, "/traj_pose", "geometry_msgs/msg/Pose")
    topics: Topics = {"/traj_pose": [point(np.zeros(3))]}
    with pytest.raises(FileError, match=r"geometry_msgs/msg/Pose on /traj_pose, not geometry_msgs/msg/PoseStamped"):
        read(write(tmp_path / "recording", topics))


@pytest.mark.parametrize(
    ("storage", "opened"),
    [(StoragePlugin.SQLITE3, ""), (StoragePlugin.MCAP, ""), (StoragePlugin.MCAP, "recording.mcap")],
)
@pytest.mark.parametrize(
    ("second", "is_read"), [("float64 x", True), ("float64 x # [m]", True), ("float32[2] x", False)]
)
def test_publishers_of_a_topic_define_its_type_alike_or_are_refused(
    tmp_path: Path, storage: StoragePlugin, opened: str, second: str, is_read: bool
) -> None:
    """Unlike definitions have unlike hashes in a folder, and unlike texts in its MCAP file without hashes."""
    folder, kind = tmp_path / "recording", "demo_msgs/msg/Place"
    with Writer(folder, version=9, storage_plugin=storage) as writer:
        for arrival, (written_as, definition) in enumerate([(kind, "float64 x"), ("demo_msgs/msg/Plane", second)]):
            store = get_typestore(Stores.EMPTY)
            store.register(get_types_from_msg(definition, kind))
            type_hash = "unknown" if opened else store.hash_rihs01(kind)
            publisher = writer.add_connection("/place", written_as, msgdef=definition, rihs01=type_hash)
            writer.write(publisher, arrival, b"\0\1\0\0" + np.float64(2.5).tobytes())
    for file in folder.iterdir():  # rosbags itself writes one definition for each type
        file.write_bytes(file.read_bytes().replace(b"Plane", b"Place"))
    with Bag(folder / opened) as bag:
        if is_read:
            assert [one.x for one in bag.messages("/place", kind)] == [2.5, 2.5]
        else:
            with pytest.raises(FileError, match=f"publishers on /place that define {kind} differently"):
                [*bag.messages("/place", kind)]


def test_cables_of_another_arm(tmp_path: Path) -> None:
    topics = run()
    topics["/cable_states"][50].name[2] = "tendon_3"
    with pytest.raises(FileError, match="holds no section_1_cable_3; recorded with another arm"):
        read(write(tmp_path / "recording", topics))


@pytest.mark.parametrize(("field", "values"), [("position", []), ("position", [0.1]), ("velocity", [0.1] * 9)])
def test_arrays_that_do_not_fit_the_names(tmp_path: Path, field: str, values: list[float]) -> None:
    topics = run()
    setattr(topics["/cable_states"][50], field, np.array(values))
    with pytest.raises(FileError, match=f"{len(values)} values for 8 names"):
        read(write(tmp_path / "recording", topics))


def test_values_that_are_not_finite(tmp_path: Path) -> None:
    topics = run()
    topics["/joint_states"][50].position[0] = np.nan
    with pytest.raises(FileError, match="nan for section_2_"):
        read(write(tmp_path / "recording", topics))


@pytest.mark.parametrize("topic", ["/traj_pose", "/cable_states"])
@pytest.mark.parametrize("count", [0, 2])
def test_too_few_messages(tmp_path: Path, topic: str, count: int) -> None:
    topics = run()
    del topics[topic][count:]
    with pytest.raises(InvalidValueError, match=f"in the recording is {count}; allowed: 3 or more"):
        report_on(read(write(tmp_path / "recording", topics)))


@pytest.fixture(scope="module", params=list(StoragePlugin))
def short_recording(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    topics = {topic: messages[: 8 * len(messages) // N] for topic, messages in run().items()}
    return write(tmp_path_factory.mktemp("damaged") / "recording", topics, request.param)


@given(st.booleans(), st.floats(0, 1), st.floats(0, 1), st.binary(max_size=16))
def test_damage_is_reported_in_one_line(
    short_recording: Path, in_metadata: bool, place: float, removed: float, put_in: bytes
) -> None:
    (file,) = (path for path in short_recording.iterdir() if (path.name == "metadata.yaml") == in_metadata)
    whole = file.read_bytes()
    start = int(place * len(whole))
    end = start + int(removed**4 * len(whole))
    file.write_bytes(whole[:start] + put_in + whole[end:])
    try:
        found = outcome(lambda: report_on(read(short_recording)))
    finally:
        file.write_bytes(whole)
    if isinstance(found, ContinuumError):
        assert "\n" not in str(found)


@pytest.mark.parametrize("share", [0.0, 0.999])
@pytest.mark.parametrize("name", ["metadata.yaml", "recording.mcap"])
def test_a_cut_file_is_refused(tmp_path: Path, name: str, share: float) -> None:
    file = write(tmp_path / "recording", run()) / name
    whole = file.read_bytes()
    file.write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(FileError, match="is not a readable rosbag2 recording") as error:
        read(tmp_path / "recording")
    assert "\n" not in str(error.value)
