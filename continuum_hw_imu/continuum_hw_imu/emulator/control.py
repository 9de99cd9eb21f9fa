"""Control socket of the emulator: a UNIX socket that accepts orders line by line and answers each."""

from __future__ import annotations

import socket
from collections.abc import Callable
from pathlib import Path

from continuum.errors import FileError

_LONGEST_LINE = 1000
_LONGEST_PATH = 100
"""Longest path [bytes]; the limit of the system is 107."""


class ControlSocket:
    """Listening socket. Each line receives the one-line answer of ``handle``.

    Raises:
        FileError: the socket cannot be created.
    """

    def __init__(self, path: Path, handle: Callable[[str], str]) -> None:
        if len(str(path).encode()) > _LONGEST_PATH:
            raise FileError(path, f"is too long for a socket; allowed: {_LONGEST_PATH} bytes")
        if path.is_socket():
            _refuse_one_in_use(path)
        self._path, self._handle = path, handle
        self._listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            if path.is_socket():
                path.unlink()
            self._listener.bind(str(path))
        except OSError as error:
            self._listener.close()
            raise FileError(path, f"cannot be created: {error.strerror}") from None
        self._listener.listen()
        self._listener.setblocking(False)
        self._kept: dict[socket.socket, bytes] = {}

    @property
    def files(self) -> list[int]:
        """Return the file descriptors to wait for."""
        return [self._listener.fileno(), *(client.fileno() for client in self._kept)]

    def serve(self) -> None:
        """Answer the lines that have arrived."""
        try:
            client, _ = self._listener.accept()
            client.setblocking(False)
            self._kept[client] = b""
        except BlockingIOError:
            pass
        for client in list(self._kept):
            if not self._serve(client):
                client.close()
                del self._kept[client]

    def close(self) -> None:
        """Remove the socket."""
        for client in self._kept:
            client.close()
        self._listener.close()
        self._path.unlink(missing_ok=True)

    def _serve(self, client: socket.socket) -> bool:
        """Answer one client; return whether it is still connected."""
        try:
            data = client.recv(1 << 16)
        except BlockingIOError:
            return True
        except OSError:
            return False
        *lines, rest = (self._kept[client] + data).split(b"\n")
        self._kept[client] = rest
        try:
            for line in lines:
                client.sendall((self._handle(line.decode("utf-8", "replace").strip()) + "\n").encode())
        except OSError:  # it does not read its answers
            return False
        return bool(data) and len(rest) < _LONGEST_LINE


def _refuse_one_in_use(path: Path) -> None:
    """Refuse a socket with a listener; one without is a remnant of a killed emulator."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as probe:
        try:
            probe.connect(str(path))
        except ConnectionRefusedError:
            return
    raise FileError(path, "belongs to another running emulator")
