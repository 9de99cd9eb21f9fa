"""Recover an MCAP recording whose recorder was killed, or whose file was damaged, as a proper recording.

    python3 -m continuum_manipulator.bag_recovery BROKEN RECOVERED

A killed recorder leaves a file without index and ``metadata.yaml``, but every flushed chunk is complete. The layout of
chunks follows https://mcap.dev/spec. Chunks with damaged bytes are omitted.
"""

from __future__ import annotations

import io
import struct
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
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


_Place = tuple[int, int, int]
"""Kind of a record, and where its content starts and ends."""


@dataclass(frozen=True)
class Recovered:
    """Result of a recovery.

    Attributes:
        messages: number of copied messages.
        damaged: number of damaged records that were omitted; a wrong length counts as one, whatever follows it.
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
        """Copy chunk by chunk, after all schemas and channels: a finished file repeats them after its chunks."""
        records = [*_records(data)]
        self._each(self._announce, (Opcode.SCHEMA, Opcode.CHANNEL), data, records)
        self._each(self._copy, (Opcode.CHUNK, Opcode.MESSAGE), data, records)
        walked = records[-1][2] if records else MAGIC_SIZE
        if data.endswith(_MAGIC) and walked < len(data) - len(_MAGIC):
            self.damaged += 1  # a wrong length leads past the end of a finished file

    def _each(
        self, step: Callable[[McapRecord], None], kinds: Sequence[int], data: bytes, records: Iterable[_Place]
    ) -> None:
        """Do a step with every record of some kinds; count those that are damaged."""
        for kind, start, end in records:
            if kind in kinds:
                try:
                    step(_parsed(kind, data[start:end]))
                except _DAMAGED:
                    self.damaged += 1

    def _announce(self, record: McapRecord) -> None:
        if isinstance(record, Schema):
            self._types[record.id] = record.name
        elif isinstance(record, Channel):
            self._channels[record.id] = record

    def _copy(self, record: McapRecord) -> None:
        """Copy a message, or all messages of a chunk if the whole chunk is undamaged."""
        records = breakup_chunk(record, validate_crc=True) if isinstance(record, Chunk) else [record]
        for one in records:
            self._announce(one)
        messages = [one for one in records if isinstance(one, Message)]
        for message, topic in [(one, self._topic(self._channels[one.channel_id])) for one in messages]:
            self._bag.write(topic, message.data, message.log_time)
            self.messages += 1

    def _topic(self, channel: Channel) -> Connection:
        name = channel.topic
        if name not in self._topics:
            offers = _qos(channel.metadata.get("offered_qos_profiles", ""))
            self._topics[name] = self._bag.add_topic(name, self._types[channel.schema_id], offers)
        return self._topics[name]


def _records(data: bytes) -> Iterator[_Place]:
    """Kind, start and end of the content of every record that is complete."""
    end = MAGIC_SIZE
    while end + _HEAD.size <= len(data):
        kind, length = _HEAD.unpack_from(data, end)
        start = end + _HEAD.size
        end = start + length
        if end > len(data):
            return
        yield kind, start, end


def _parsed(kind: int, content: bytes) -> McapRecord:
    """Parse a record of a kind that a recovery needs."""
    stream = ReadDataStream(io.BytesIO(content))
    if kind == Opcode.MESSAGE:
        return Message.read(stream, len(content))
    return {Opcode.SCHEMA: Schema, Opcode.CHANNEL: Channel, Opcode.CHUNK: Chunk}[Opcode(kind)].read(stream)


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
        print(f"{found.messages} messages recovered to {sys.argv[2]}; damaged records left out: {found.damaged}")
    except ContinuumError as error:
        print(f"bag_recovery: error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
