"""A rosbag2 recording read by `rosbags`, without ROS: message definitions come from the recording itself.

Only requested topics are read: others may have unknown types.
"""

from __future__ import annotations

import shlex
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import apsw
from rosbags.interfaces import Connection, MessageDefinitionFormat
from rosbags.interfaces.typing import Typesdict
from rosbags.rosbag2 import Reader, ReaderError
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, TypesysError, get_types_from_idl, get_types_from_msg, get_typestore

from continuum.errors import FileError

_DAMAGE = (
    *(ReaderError, TypesysError, SerdeError, OSError),
    # errors that rosbags lets through if bytes of a recording were changed or cut off
    *(apsw.Error, struct.error, ValueError, TypeError, AttributeError, LookupError, ArithmeticError, MemoryError),
    *(AssertionError, EOFError, RecursionError),
)


_NEXT_IDL = "=" * 80 + "\n"
_STORAGES, _COMPRESSED, _METADATA = (".mcap", ".db3"), ".zstd", "metadata.yaml"  # names of files of rosbag2


class Bag:
    """An open recording. Use as a context manager.

    Args:
        path: folder of the recording, the ``metadata.yaml`` in it, or its storage file.

    Raises:
        FileError: no recording there, or a damaged one; also raised by the methods.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = _whole(Path(path))
        if self.path.is_dir() and not (self.path / _METADATA).exists():
            raise self._unreadable("it has no metadata.yaml")
        with self._readable():
            self._reader = Reader(self.path)
            self._reader.open()

    def __enter__(self) -> Bag:
        return self

    def __exit__(self, *_: object) -> None:
        self._reader.close()

    @property
    def topics(self) -> dict[str, int]:
        """Number of messages by topic."""
        with self._readable():
            return {_absolute(topic): info.msgcount for topic, info in self._reader.topics.items()}

    @property
    def types(self) -> dict[str, str]:
        """Type of the messages by topic, e.g. ``sensor_msgs/msg/JointState``."""
        return {_absolute(one.topic): one.msgtype for one in self._reader.connections}

    def topics_in_words(self) -> str:
        """Return all topics with the types of their messages."""
        return ", ".join(f"{topic} ({kind})" for topic, kind in sorted(self.types.items())) or "none"

    def messages(self, topic: str, message_type: str) -> Iterator[Any]:
        """Yield the messages of one topic, e.g. of type ``sensor_msgs/msg/JointState``, in the order of their arrival.

        Raises:
            FileError: the recording has no such topic, messages of another type on it, or publishers whose definitions
                of the type differ.
        """
        connections = self._connections(topic)
        if not connections:
            raise FileError(self.path, f"has no topic {topic}; it has {self.topics_in_words()}")
        for connection in connections:
            if connection.msgtype != message_type:
                raise FileError(self.path, f"has {connection.msgtype} on {topic}, not {message_type}")
        with self._readable():
            types = get_typestore(Stores.EMPTY)
            types.register(self._common_definition(topic, connections))
            for connection, _, raw in self._reader.messages(connections):
                yield types.deserialize_cdr(raw, connection.msgtype)

    def _connections(self, topic: str) -> list[Connection]:
        return [one for one in self._reader.connections if _absolute(one.topic) == topic]

    def _common_definition(self, topic: str, connections: list[Connection]) -> Typesdict:
        """Return the definition of a topic's type; hashes are compared too, as `rosbags` gives all the same text."""
        hashes = {one.digest for one in connections} - {""}
        definition, *others = [_definition(one) for one in connections]
        if len(hashes) > 1 or any(other != definition for other in others):
            raise FileError(self.path, f"has publishers on {topic} that define {connections[0].msgtype} differently")
        return definition

    @contextmanager
    def _readable(self) -> Iterator[None]:
        """Turn errors within into one line about the recording."""
        try:
            yield
        except _DAMAGE as error:
            reason = " ".join(str(error).split()) or type(error).__name__
            raise self._unreadable(reason) from error

    def _unreadable(self, reason: str) -> FileError:
        """Return an error that says what is wrong with the recording, and what may still be recovered."""
        problem = f"is not a readable rosbag2 recording ({reason})"
        if any(self.path.glob("*.mcap")) or (self.path.is_file() and self.path.suffix == ".mcap"):
            problem += f"; its intact part can be recovered with {recovery_command(self.path)}"
        return FileError(self.path, problem)


def is_bag(path: str | Path) -> bool:
    """Whether a path is a recording, its folder or a file in it, judged by its name."""
    return Path(path).is_dir() or Path(path).name == _METADATA or _is_storage(Path(path))


def _is_storage(path: Path) -> bool:
    return path.name.lower().removesuffix(_COMPRESSED).endswith(_STORAGES)


def _whole(path: Path) -> Path:
    """Return the folder of a file that cannot be read alone: metadata, or the only compressed storage file."""
    if path.name == _METADATA:
        return path.parent
    metadata = path.parent / _METADATA
    if not (_is_storage(path) and path.is_file() and metadata.is_file()):
        return path
    compressed = b"compression_mode: message" in metadata.read_bytes().lower() or path.suffix.lower() == _COMPRESSED
    return path.parent if compressed and sum(map(_is_storage, path.parent.iterdir())) == 1 else path


def recovery_command(path: Path) -> str:
    """Return a shell command that copies the intact part of a damaged MCAP recording, folder or file, to a new one."""
    return f"python3 -m continuum_manipulator.bag_recovery {shlex.quote(str(path))} RECOVERED"


def _definition(connection: Connection) -> Typesdict:
    """Return a topic's message type and its parts, from Jazzy if the recording does not define them."""
    text, kind = connection.msgdef.data, connection.msgdef.format
    if kind is MessageDefinitionFormat.NONE:
        return get_typestore(Stores.ROS2_JAZZY).fielddefs
    if kind is MessageDefinitionFormat.MSG:
        return get_types_from_msg(text, connection.msgtype)
    found: Typesdict = {}
    for part in filter(None, text.split(_NEXT_IDL)):
        found |= get_types_from_idl(part.partition("\n")[2] if part.startswith("IDL: ") else part)
    return found


def _absolute(topic: str) -> str:
    """Return a topic's absolute name; older recorders wrote relative ones."""
    return topic if topic.startswith("/") else f"/{topic}"


def stamp_ns(message: Any) -> int:
    """Return the stamp of a message with a header [ns]."""
    stamp = message.header.stamp
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
