"""Where the page is served: the usual address, whether one can listen there, and how a browser is told of it."""

from __future__ import annotations

import errno
import socket

from continuum.errors import InvalidValueError

HOST = "127.0.0.1"
"""This host alone."""

PORT = 8080

_EVERY = ("0.0.0.0", "::")  # noqa: S104
"""Of all addresses of the machine; no browser goes there."""


def url(host: str, port: int) -> str:
    """What to open in a browser of this machine."""
    name = "localhost" if host in _EVERY else host
    return f"http://{_bracketed(name)}:{port}"


def check_address(host: str, port: int) -> None:
    """Refuse an address that nobody can listen on: the server itself would look for another port.

    Raises:
        InvalidValueError: it is none of this machine's, or its port is taken.
    """
    if not 0 <= port <= 65535:
        raise InvalidValueError("port", port, "a whole number from 0 to 65535, 0 for any that is free")
    try:
        family, kind, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        with socket.socket(family, kind) as trial:
            trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            trial.bind(address)
    except OSError as error:
        way_out = (
            "; --port 0 (of the node: -p port:=0) takes any that is free" if error.errno == errno.EADDRINUSE else ""
        )
        raise InvalidValueError(
            "address",
            f"{_bracketed(host)}:{port}",
            f"one of this machine's, and a port that is free ({error.strerror or error}){way_out}",
        ) from error


def _bracketed(host: str) -> str:
    """A numeric address of IPv6 stands in brackets before a port."""
    return f"[{host}]" if ":" in host else host
