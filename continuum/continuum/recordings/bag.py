"""A rosbag2 recording read by `rosbags`, without ROS: message definitions come from the recording itself."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rosbags.highlevel import AnyReader, AnyReaderError
from rosbags.interfaces import Connection
from rosbags.rosbag2 import ReaderError
from rosbags.typesys import Stores, get_typestore

from continuum.errors import FileError, InvalidValueError


class Bag:
    """An open recording. Use as a context manager.

    Args:
        path: folder of the recording (with ``metadata.yaml``).

    Raises:
        FileError: no recording there, or a damaged one.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        try:
            self._reader = AnyReader([self.path], default_typestore=get_typestore(Stores.ROS2_JAZZY))
            self._reader.open()
        except (AnyReaderError, ReaderError, OSError) as error:
            raise FileError(self.path, f"is not a readable rosbag2 recording ({error})") from error

    def __enter__(self) -> Bag:
        return self

    def __exit__(self, *_: object) -> None:
        self._reader.close()

    @property
    def topics(self) -> dict[str, int]:
        """Number of messages by topic."""
        return {topic: info.msgcount for topic, info in self._reader.topics.items()}

    def messages(self, topic: str) -> Iterator[Any]:
        """The messages of one topic in the order of their arrival.

        Raises:
            InvalidValueError: the recording has no such topic.
        """
        if not self._connections(topic):
            raise InvalidValueError("topic", topic, f"one of {sorted(self._reader.topics)}, recorded in {self.path}")
        for connection, _, raw in self._reader.messages(self._connections(topic)):
            yield self._reader.deserialize(raw, connection.msgtype)

    def _connections(self, topic: str) -> list[Connection]:
        return [connection for connection in self._reader.connections if connection.topic == topic]


def stamp_ns(message: Any) -> int:
    """Stamp of a message with a header [ns]."""
    stamp = message.header.stamp
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
