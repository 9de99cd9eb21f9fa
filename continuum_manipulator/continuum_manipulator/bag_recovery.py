"""Recover an MCAP recording whose recorder was killed, or whose file was damaged, as a proper recording.

    python3 -m continuum_manipulator.bag_recovery BROKEN RECOVERED

A killed recorder leaves a file without index and ``metadata.yaml``, but every flushed chunk is complete. The layout of
chunks follows https://mcap.dev/spec. Chunks with damaged bytes are omitted.
"""

from __future__ import annotations

import io
import struct
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, McapRecord, Message, Schema
from mcap.stream_reader import MAGIC_SIZE, breakup_chunk
from rosbags.interfaces import Connection, Qos
from rosbags.rosbag2 import ReaderError
from rosbags.rosbag2.metadata import parse_qos

from continuum.errors import ContinuumError, FileError
from continuum_manipulator.bag_writer import BagWriter

_MAGIC = b"\x89MCAP0\r\n"
_HEAD = struct.Struct("<BQ")
"""Head of a record: its kind and its length [bytes]."""

_DAMAGED = (McapError, struct.error, LookupError, ValueError, MemoryError, RuntimeError, zstandard.ZstdError)
"""Exceptions of parsing and decompression for damaged bytes; lz4 raises RuntimeError."""


@dataclass(frozen=True)
class Recovered:
    """Result of a recovery.

    Attributes:
        messages: number of copied messages.
        damaged: number of damaged records of the file (chunks, schemas, channels) that were omitted.
    """

    messages: int
    damaged: int


def recover(broken: str | Path, recovered: str | Path) -> Recovered:
    """Copy the undamaged chunks of a recording, a folder or its storage file, to a new folder.

    Raises:
        FileError: there is no MCAP file, it cannot be read, or the new folder exists already.
    """
    path = Path(broken)
    files = [path] if path.is_file() else sorted(path.glob("*.mcap"))
    if not files:
        raise FileError(broken, "contains no MCAP file")
    data = {file: _read(file) for file in files}
    with BagWriter(recovered) as bag:
        topics: dict[str, Connection] = {}
        copies = [_Copy(bag, topics) for _ in files]
        for copy, file in zip(copies, files, strict=True):
            copy.take(data[file])
        return Recovered(sum(copy.messages for copy in copies), sum(copy.damaged for copy in copies))


def _read(file: Path) -> bytes:
    try:
        data = file.read_bytes()
    except OSError as error:
        raise FileError(file, f"cannot be read ({error.strerror})") from error
    if not data.startswith(_MAGIC):
        raise FileError(file, "is not an MCAP file")
    return data


class _Copy:
    """Copies the chunks of one file into a recording; ``topics`` are the topics that the recording already has."""

    def __init__(self, bag: BagWriter, topics: dict[str, Connection]) -> None:
        self._bag = bag
        self._topics = topics
        self._types: dict[int, str] = {}
        self._channels: dict[int, Channel] = {}
        self.messages = self.damaged = 0

    def take(self, data: bytes) -> None:
        """Copy all chunks; a finished file repeats its schemas and channels after the chunks."""
        chunks: list[list[McapRecord]] = []
        for kind, content in _records(data):
            try:
                record = _parsed(kind, content)
                if isinstance(record, Chunk):
                    chunks.append(breakup_chunk(record, validate_crc=True))
                else:
                    self._announce(record)
            except _DAMAGED:
                self.damaged += 1
        for records in chunks:
            try:
                self._copy(records)
            except LookupError:  # the channel of a message was in a damaged record
                self.damaged += 1

    def _announce(self, record: McapRecord | None) -> None:
        if isinstance(record, Schema):
            self._types[record.id] = record.name
        elif isinstance(record, Channel):
            self._channels[record.id] = record

    def _copy(self, records: list[McapRecord]) -> None:
        for record in records:
            self._announce(record)
            if isinstance(record, Message):
                self._bag.write(self._topic(self._channels[record.channel_id]), record.data, record.log_time)
                self.messages += 1

    def _topic(self, channel: Channel) -> Connection:
        name = channel.topic
        if name not in self._topics:
            offers = _qos(channel.metadata.get("offered_qos_profiles", ""))
            self._topics[name] = self._bag.add_topic(name, self._types[channel.schema_id], offers)
        return self._topics[name]


def _records(data: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield kind and content of every complete record."""
    start = MAGIC_SIZE
    while start + _HEAD.size <= len(data):
        kind, length = _HEAD.unpack_from(data, start)
        start += _HEAD.size + length
        if start > len(data):
            return
        yield kind, data[start - length : start]


def _parsed(kind: int, content: bytes) -> McapRecord | None:
    """Return the record, or None for a kind that the recovery does not need."""
    of_kind = {Opcode.SCHEMA: Schema, Opcode.CHANNEL: Channel, Opcode.CHUNK: Chunk}.get(kind)
    return None if of_kind is None else of_kind.read(ReadDataStream(io.BytesIO(content)))


def _qos(offers: str) -> list[Qos]:
    """Return the offered quality of service; an empty list if it cannot be parsed, since messages do not need it."""
    try:
        return parse_qos(offers)
    except (ReaderError, TypeError, AttributeError, LookupError, ValueError):
        return []


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
