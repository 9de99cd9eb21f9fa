"""Recordings: told, played, and recorded again."""

from itertools import pairwise
from pathlib import Path

import pytest
from rclpy.qos import QoSDurabilityPolicy, QoSReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Int32

from ros2_standin.bag_play import recorded_qos, with_clock

START = 1_700_000_000 * 10**9
COUNT = 30
STEP = 20_000_000


def offer(reliability: str, durability: str, depth: int = 5) -> Qos:
    none = QosTime(0, 0)
    return Qos(
        QosHistory.KEEP_LAST, depth, QosReliability[reliability], QosDurability[durability], none, none,
        QosLiveliness.AUTOMATIC, none, False,
    )  # fmt: skip


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Thirty numbers, 20 ms apart, that a latched publisher said."""
    path = tmp_path / "bag"
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        numbers = writer.add_connection(
            "/numbers", "std_msgs/msg/Int32", typestore=get_typestore(Stores.ROS2_JAZZY),
            offered_qos_profiles=[offer("RELIABLE", "TRANSIENT_LOCAL", depth=COUNT)],
        )  # fmt: skip
        for i in range(COUNT):
            writer.write(numbers, START + i * STEP, serialize_message(Int32(data=i)))
    return path


def test_info(ros2, bag: Path) -> None:
    lines = dict(line.split(": ", 1) for line in ros2("bag", "info", bag).stdout.strip().splitlines())
    text = {label: value.strip() for label, value in lines.items()}
    assert text["Files"] == "bag.mcap"
    assert text["Storage id"] == "mcap"
    assert text["Duration"] == "0.580000000s"
    assert text["Messages"] == str(COUNT)
    assert text["Start"].endswith("(1700000000.000000000)")
    assert text["Topic information"].startswith(f"Topic: /numbers | Type: std_msgs/msg/Int32 | Count: {COUNT} |")


def test_mistakes(ros2, bag: Path) -> None:
    assert "does not exist" in ros2("bag", "info", "nix", code=1).stderr
    (bag / "metadata.yaml").write_text("nonsense")
    assert "cannot be read" in ros2("bag", "info", bag, code=1).stderr
    assert "already exists" in ros2("bag", "record", "-a", "-o", bag, code=1).stderr
    assert "only one option" in ros2("bag", "record", code=1).stderr


@pytest.mark.ros
def test_play_reports_what_and_that_it_ended(ros2, bag: Path) -> None:
    output = ros2("bag", "play", bag, "--rate", "5", "--clock").stderr
    assert f"playing '{bag}': 0.6 s, 1 topics" in output
    assert f"{COUNT}  /numbers" in output
    assert output.splitlines()[-1] == f"[INFO] [rosbag2_player]: ended, {COUNT} messages played"


@pytest.mark.ros
def test_played_messages_are_those_recorded(ros2, bag: Path, tmp_path: Path) -> None:
    """Play over and over, record that, and find the numbers in turn, nothing missing between them."""
    player = ros2.start("bag", "play", bag, "--loop", "--rate", "2", "--clock", "50", "--remap", "/numbers:=/again")
    recorder = ros2.start("bag", "record", "/again", "-o", tmp_path / "copy")
    clock = ros2("topic", "echo", "--once", "/clock", "--field", "clock.sec", "--spin-time", "120")
    assert clock.stdout == "1700000000\n---\n"
    received = ros2.start("topic", "echo", "/again", "--field", "data", "--spin-time", "120")
    received.wait_for("---\n", count=2 * COUNT)
    assert recorder.stop() == 0
    assert player.stop() == 2
    assert "Traceback" not in player.stderr
    with Reader(tmp_path / "copy") as reader:
        assert [connection.msgtype for connection in reader.connections] == ["std_msgs/msg/Int32"]
        numbers = [deserialize_message(data, Int32).data for _, _, data in reader.messages()]
    assert len(numbers) > COUNT
    assert all((b - a) % COUNT == 1 for a, b in pairwise(numbers))


def test_offers_as_strict_as_the_strictest_recorded() -> None:
    mixed = recorded_qos([offer("BEST_EFFORT", "VOLATILE"), offer("RELIABLE", "TRANSIENT_LOCAL")])
    assert (mixed.reliability, mixed.durability) == (
        QoSReliabilityPolicy.RELIABLE, QoSDurabilityPolicy.TRANSIENT_LOCAL,
    )  # fmt: skip
    plain = recorded_qos([offer("BEST_EFFORT", "VOLATILE")])
    assert (plain.reliability, plain.durability) == (QoSReliabilityPolicy.BEST_EFFORT, QoSDurabilityPolicy.VOLATILE)
    assert recorded_qos([]).reliability == QoSReliabilityPolicy.RELIABLE


def test_clock_ticks_between_the_messages() -> None:
    messages = [(START + i * STEP, None, i) for i in range(3)]
    mixed = list(with_clock(messages, None, START, START + 2 * STEP, period=0.01))
    stamps = [stamp for stamp, _, _ in mixed]
    assert stamps == sorted(stamps)
    ticks = [stamp for stamp, _, message in mixed if isinstance(message, Clock)]
    assert ticks == list(range(START, START + 2 * STEP + 1, 10_000_000))
    assert [message for _, _, message in mixed if not isinstance(message, Clock)] == [0, 1, 2]
