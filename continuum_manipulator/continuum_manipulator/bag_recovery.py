"""What is left of an MCAP recording whose recorder was killed, as a proper recording.

    python3 -m continuum_manipulator.bag_recovery BROKEN RECOVERED

A killed recorder leaves a file without index and ``metadata.yaml``. Every chunk that was flushed is whole; its layout
is that of the MCAP specification, https://mcap.dev/spec.
"""

from __future__ import annotations

import struct
import sys
from collections.abc import Iterator
from pathlib import Path

from rosbags.interfaces import Connection
from rosbags.rosbag2.metadata import parse_qos

from continuum.errors import ContinuumError, FileError
from continuum_manipulator.bag_writer import BagWriter

_MAGIC = b"\x89MCAP0\r\n"
_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK = 0x03, 0x04, 0x05, 0x06
_BEFORE_RECORDS = struct.Struct("<QQQI")  # of a chunk: first and last time, size, checksum; then the compression's name
_MESSAGE_HEAD = struct.Struct("<HIQQ")  # channel, sequence, time of logging, time of publishing


def recover(broken: str | Path, recovered: str | Path) -> int:
    """Copy the whole chunks of the recording in folder ``broken`` to a new folder; return the number of messages.

    Raises:
        FileError: there is no MCAP file in the folder, it is compressed, or the new folder exists.
    """
    files = sorted(Path(broken).glob("*.mcap"))
    if not files:
        raise FileError(broken, "holds no MCAP file")
    data = files[0].read_bytes()
    if not data.startswith(_MAGIC):
        raise FileError(files[0], "is no MCAP file")
    with BagWriter(recovered) as bag:
        return sum(_copy_chunks(data, files[0], bag))


def _copy_chunks(data: bytes, path: Path, bag: BagWriter) -> Iterator[int]:
    """Copy chunk by chunk, giving the number of messages of each."""
    types: dict[int, str] = {}
    topics: dict[int, Connection] = {}
    for kind, record in _records(data, len(_MAGIC)):
        if kind == _CHUNK:
            yield _copy_chunk(_chunk_content(record, path), types, topics, bag)


def _copy_chunk(content: bytes, types: dict[int, str], topics: dict[int, Connection], bag: BagWriter) -> int:
    count = 0
    for kind, record in _records(content, 0):
        if kind == _SCHEMA:
            types[_short(record, 0)] = _text(record, 2)[0]
        elif kind == _CHANNEL:
            name, end = _text(record, 4)
            _, end = _text(record, end)
            topics[_short(record, 0)] = bag.add_topic(name, types[_short(record, 2)], parse_qos(_offers(record, end)))
        elif kind == _MESSAGE:
            channel, _, stamp, _ = _MESSAGE_HEAD.unpack_from(record)
            bag.write(topics[channel], record[_MESSAGE_HEAD.size :], stamp)
            count += 1
    return count


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
    return record[end + 8 :]


def _offers(record: bytes, start: int) -> str:
    """The entry ``offered_qos_profiles`` of a channel's metadata."""
    key, end = _text(record, start + 4)
    return _text(record, end)[0] if key == "offered_qos_profiles" else ""


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
        print(f"{recover(sys.argv[1], sys.argv[2])} messages recovered to {sys.argv[2]}")
    except ContinuumError as error:
        print(f"bag_recovery: error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
