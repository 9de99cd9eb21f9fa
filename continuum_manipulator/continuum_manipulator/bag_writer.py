"""Write a rosbag2 recording (metadata version 9) with the library rosbags."""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

from rosbags.interfaces import Connection, Qos
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.rosbag2.errors import WriterError
from rosbags.rosbag2.storage_mcap import McapWriter

from continuum.errors import FileError, InvalidValueError
from continuum_manipulator.message_definitions import message_definition

STORAGES = ("mcap", "sqlite3")


class BagWriter:
    """An open recording; as a context manager it is finished at the end, also after an error.

    Data written before the last :meth:`flush` survive even if the process is killed: see ``bag_recovery``.

    Args:
        path: folder of the recording; it must not exist.
        storage: ``mcap`` or ``sqlite3``.

    Raises:
        FileError: the folder exists or cannot be created; the methods raise it if they cannot write.
        InvalidValueError: the storage is unknown.
    """

    def __init__(self, path: str | Path, storage: str = "mcap") -> None:
        if storage not in STORAGES:
            raise InvalidValueError("storage", storage, f"one of {', '.join(STORAGES)}")
        self.path = Path(path)
        try:
            self._writer = Writer(self.path, version=9, storage_plugin=StoragePlugin[storage.upper()])
            self._writer.open()
        except WriterError:
            raise FileError(self.path, "exists already and is not overwritten") from None
        except OSError as error:
            raise FileError(self.path, f"cannot be created ({error.strerror})") from error

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None):
        self.close()

    @property
    def counts(self) -> dict[str, int]:
        """Number of written messages by topic."""
        return {connection.topic: self._writer.counts[connection.id] for connection in self._writer.connections}

    def add_topic(self, name: str, message_type: str, offered_qos: Sequence[Qos]) -> Connection:
        """Add a topic and return its handle for :meth:`write`.

        Raises:
            FileError: the message type is not installed, or the topic exists already.
        """
        definition, type_hash = message_definition(message_type)
        try:
            return self._writer.add_connection(
                name, message_type, msgdef=definition, rihs01=type_hash, offered_qos_profiles=offered_qos
            )
        except WriterError as error:
            raise FileError(self.path, str(error)) from error

    def write(self, handle: Connection, raw: bytes, stamp: int) -> None:
        """Write a serialised message, received at ``stamp`` [ns since 1970]."""
        try:
            self._writer.write(handle, stamp, raw)
        except (OSError, sqlite3.Error) as error:
            raise FileError(self.path, f"cannot be written ({error})") from error

    def flush(self) -> None:
        """Pass all written data to the operating system."""
        storage = self._writer.storage
        try:
            if not isinstance(storage, McapWriter):
                storage.conn.commit()
                return
            if storage.chunk.msgs:
                storage.close_chunk()
            storage.bio.flush()
        except (OSError, sqlite3.Error) as error:
            raise FileError(self.path, f"cannot be written ({error})") from error

    def close(self) -> None:
        """Finish the recording with its index and ``metadata.yaml``. A second call does nothing."""
        if self._writer.storage is None:
            return
        try:
            self._writer.close()
        except (OSError, sqlite3.Error) as error:
            raise FileError(self.path, f"cannot be finished ({error})") from error
