"""Address of the page: its default, a check that it can be served, and its URL."""

from __future__ import annotations

import errno
import socket

from continuum.errors import InvalidValueError

HOST = "127.0.0.1"
"""Reachable from this host only."""

PORT = 8080

_EVERY = ("0.0.0.0", "::")  # noqa: S104
"""Stands for all addresses of the machine; browsers cannot open it."""


def url(host: str, port: int) -> str:
    """Return the URL to open in a browser on this machine."""
    name = "localhost" if host in _EVERY else host
    return f"http://{_bracketed(name)}:{port}"


def check_address(host: str, port: int) -> None:
    """Check that the page can be served on an address; the server itself would choose another port.

    Raises:
        InvalidValueError: the address is not of this machine, or the port is in use.
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
    """Return the host as in a URL, where a numeric IPv6 address is in brackets."""
    return f"[{host}]" if ":" in host else host
