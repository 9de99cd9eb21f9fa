"""What is left of an MCAP recording whose recorder was killed, or whose file was damaged, as a proper recording.

    python3 -m continuum_manipulator.bag_recovery BROKEN RECOVERED

A killed recorder leaves a file without index and ``metadata.yaml``. Every chunk that was flushed is whole; its layout
is that of the MCAP specification, https://mcap.dev/spec. A chunk with damaged bytes is left out.
"""

from __future__ import annotations

import struct
import sys
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from rosbags.interfaces import Connection, Qos
from rosbags.rosbag2 import ReaderError
from rosbags.rosbag2.metadata import parse_qos

from continuum.errors import ContinuumError, FileError
from continuum_manipulator.bag_writer import BagWriter

_MAGIC = b"\x89MCAP0\r\n"
_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK = 0x03, 0x04, 0x05, 0x06
_BEFORE_RECORDS = struct.Struct("<QQQI")  # of a chunk: first and last time, size, checksum; then the compression's name
_MESSAGE_HEAD = struct.Struct("<HIQQ")  # channel, sequence, time of logging, time of publishing

_NO_SENSE = (struct.error, LookupError, ValueError)
"""What bytes lead to that were changed."""


@dataclass(frozen=True)
class Recovered:
    """What was copied.

    Attributes:
        messages: number of messages.
        damaged: number of chunks that were left out, in whole or from where their bytes make no sense.
    """

    messages: int
    damaged: int


def recover(broken: str | Path, recovered: str | Path) -> Recovered:
    """Copy the whole chunks of a recording, a folder or its storage file, to a new folder.

    Raises:
        FileError: there is no MCAP file, it is compressed, or cannot be read, or the new folder exists.
    """
    path = Path(broken)
    files = [path] if path.is_file() else sorted(path.glob("*.mcap"))
    if not files:
        raise FileError(broken, "holds no MCAP file")
    data = {file: _read(file) for file in files}
    with BagWriter(recovered) as bag:
        topics: dict[str, Connection] = {}
        copies = [_Copy(bag, topics) for _ in files]
        for copy, file in zip(copies, files, strict=True):
            copy.take(data[file], file)
        return Recovered(sum(copy.messages for copy in copies), sum(copy.damaged for copy in copies))


def _read(file: Path) -> bytes:
    try:
        data = file.read_bytes()
    except OSError as error:
        raise FileError(file, f"cannot be read ({error.strerror})") from error
    if not data.startswith(_MAGIC):
        raise FileError(file, "is no MCAP file")
    return data


class _Copy:
    """One file's chunks on their way into a recording; ``topics`` are those that it has already."""

    def __init__(self, bag: BagWriter, topics: dict[str, Connection]) -> None:
        self._bag = bag
        self._topics = topics
        self._types: dict[int, str] = {}
        self._channels: dict[int, tuple[str, str, str]] = {}
        self.messages = self.damaged = 0

    def take(self, data: bytes, path: Path) -> None:
        """Copy chunk by chunk; a file that was finished has its channels once more, after all chunks."""
        chunks = []
        for kind, record in _records(data, len(_MAGIC)):
            if kind == _CHUNK:
                chunks.append(record)
            else:
                self._or_damaged(lambda kind=kind, record=record: self._announce(kind, record))
        for chunk in chunks:
            self._or_damaged(lambda chunk=chunk: self._copy(_chunk_content(chunk, path)))

    def _or_damaged(self, step: Callable[[], None]) -> None:
        try:
            step()
        except _NO_SENSE:
            self.damaged += 1

    def _copy(self, content: bytes) -> None:
        for kind, record in _records(content, 0):
            self._announce(kind, record)
            if kind == _MESSAGE:
                channel, _, stamp, _ = _MESSAGE_HEAD.unpack_from(record)
                self._bag.write(self._topic(channel), record[_MESSAGE_HEAD.size :], stamp)
                self.messages += 1

    def _announce(self, kind: int, record: bytes) -> None:
        if kind == _SCHEMA:
            self._types[_short(record, 0)] = _text(record, 2)[0]
        elif kind == _CHANNEL:
            name, end = _text(record, 4)
            _, end = _text(record, end)
            self._channels[_short(record, 0)] = name, self._types[_short(record, 2)], _offers(record, end)

    def _topic(self, channel: int) -> Connection:
        name, message_type, offers = self._channels[channel]
        if name not in self._topics:
            self._topics[name] = self._bag.add_topic(name, message_type, _qos(offers))
        return self._topics[name]


def _records(data: bytes, start: int) -> Iterator[tuple[int, bytes]]:
    """Kind and content of every record that is there to its end."""
    while start + 9 <= len(data):
        kind, length = struct.unpack_from("<BQ", data, start)
        start += 9 + length
        if start > len(data):
            return
        yield kind, data[start - length : start]


def _chunk_content(record: bytes, path: Path) -> bytes:
    compression, end = _text(record, _BEFORE_RECORDS.size)
    if compression:
        raise FileError(path, f"is compressed ({compression}); only recordings without compression can be recovered")
    *_, checksum = _BEFORE_RECORDS.unpack_from(record)
    content = record[end + 8 :]
    if checksum and zlib.crc32(content) != checksum:
        raise ValueError("checksum")
    return content


def _offers(record: bytes, start: int) -> str:
    """The entry ``offered_qos_profiles`` of a channel's metadata."""
    key, end = _text(record, start + 4)
    return _text(record, end)[0] if key == "offered_qos_profiles" else ""


def _qos(offers: str) -> list[Qos]:
    """Offered quality of service; none where it cannot be read: messages do not depend on it."""
    try:
        return parse_qos(offers)
    except (ReaderError, TypeError, AttributeError, *_NO_SENSE):
        return []


def _short(record: bytes, start: int) -> int:
    return struct.unpack_from("<H", record, start)[0]


def _text(record: bytes, start: int) -> tuple[str, int]:
    """The text at ``start`` and where it ends."""
    end = start + 4 + struct.unpack_from("<I", record, start)[0]
    return record[start + 4 : end].decode(), end


def main() -> int:
    if len(sys.argv) != 3:
        print("usage: python3 -m continuum_manipulator.bag_recovery BROKEN RECOVERED", file=sys.stderr)
        return 2
    try:
        found = recover(sys.argv[1], sys.argv[2])
        print(f"{found.messages} messages recovered to {sys.argv[2]}; damaged chunks left out: {found.damaged}")
    except ContinuumError as error:
        print(f"bag_recovery: error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
