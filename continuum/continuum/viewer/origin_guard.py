"""Access to the page: only browsers that show this page are connected, and only while they respond."""

from __future__ import annotations

import asyncio
import functools
import ipaddress
import socket
import threading
from collections.abc import Awaitable, Callable, Collection, Iterator
from contextlib import contextmanager
from http import HTTPStatus
from typing import Any
from urllib.parse import urlsplit

from websockets.asyncio import server as websocket_server
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import WebSocketException
from websockets.http11 import Request, Response

from continuum.burst_log import BurstLog
from continuum.errors import ContinuumError
from continuum.viewer.browser_messages import LONGEST, BrowserMessageError, check_browser_message
from continuum.viewer.layout import NAME
from continuum.viewer.page_title import titled

PATIENCE = 10.0
"""Time without a response [s] after which a browser is disconnected; a working browser reconnects automatically."""

REFUSED_SITE = "page of another site"
REFUSED_MESSAGE = "message of a browser"
SERVER_ERROR = "error of the page's server"

_ASKING = 2.0
"""Time between two pings of a browser [s]."""

_LONGEST_DETAIL = 200
"""Largest number of characters of a browser's message that are logged."""

_NO_NUMBER = "could not convert string to float"
"""Error of Python for a word as the value of a number input; the server converts any value it receives."""

_Handler = Callable[[ServerConnection], Awaitable[None]]
_Answer = Callable[[ServerConnection, Request], Response | None]

_replaced = threading.Lock()
"""Held while the function that serves is replaced."""


class NoOriginGuardError(ContinuumError):
    """The page server cannot be restricted."""


@contextmanager
def kept_guard(host: str, words: Collection[str], faults: BurstLog, title: str = NAME) -> Iterator[None]:
    """Restrict a page server that is started inside this context.

    Only browsers that show this page are admitted, and only messages that the page sends. The server itself would
    accept commands from a page of any site that is open in a browser on this host, would let a browser change all
    properties of an input or open a tunnel to a public address, and would wait indefinitely for a browser that hangs.

    The public interface of viser gives no access to the hooks of `websockets` (``process_request``,
    ``create_connection``) for the handshake. The function that it calls to serve is therefore replaced while the server
    starts. A proxy in front of the server would not help: the server's own port would stay open to pages of other
    sites on this host.

    Args:
        host: address that the page is served on.
        words: words that a browser may send; read at every message.
        faults: log of refused browsers and messages.
        title: title of the page in the browser.

    Raises:
        NoOriginGuardError: the server cannot be restricted.
    """
    known_hosts = {host, "localhost", socket.gethostname(), f"{socket.gethostname()}.local"}
    serve = websocket_server.serve
    served = threading.Event()
    put_title = titled(title)

    class Connection(ServerConnection):
        """Connection that passes on messages that the page sends and logs others."""

        async def recv(self, decode: bool | None = None) -> Any:
            while True:
                data = await super().recv(decode)
                try:
                    check_browser_message(data, words)
                except BrowserMessageError as error:
                    _note(faults, REFUSED_MESSAGE, str(error))
                else:
                    return data

    def serve_guarded(
        handler: _Handler, host: str, port: int, *, process_request: _Answer, **options: Any
    ) -> websocket_server.serve:
        def answer(connection: ServerConnection, request: Request) -> Response | None:
            origin, served_as = (", ".join(request.headers.get_all(name)) or None for name in ("Origin", "Host"))
            if is_stranger(origin, served_as, known_hosts):
                _note(faults, REFUSED_SITE, f"{origin} asks for {served_as}")
                return connection.respond(HTTPStatus.FORBIDDEN, "This is a page of another site.\n")
            return put_title(process_request(connection, request))

        async def handle(connection: ServerConnection) -> None:
            asyncio.get_running_loop().set_exception_handler(functools.partial(_note_error, faults))
            watch = asyncio.create_task(_watch(connection))
            try:
                await handler(connection)
            finally:
                watch.cancel()
                await asyncio.gather(watch, return_exceptions=True)  # the connection may have ended meanwhile

        served.set()
        hooks = {"process_request": answer, "create_connection": Connection, "max_size": LONGEST}
        return serve(handle, host, port, **(options | hooks))

    with _replaced:
        websocket_server.serve = serve_guarded  # type: ignore[assignment, misc]
        try:
            yield
        finally:
            websocket_server.serve = serve  # type: ignore[misc]
    if not served.is_set():
        raise NoOriginGuardError("this version of viser cannot be restricted; docs/dependencies.md names one that can")


def is_stranger(origin: str | None, served_as: str | None, known_hosts: set[str]) -> bool:
    """Return whether a browser shows a page of another site.

    Args:
        origin: site of the page that connects, as stated by the browser; None for a client that is not a browser.
        served_as: host name and port of the request. A host name that is not one of the server is that of a site which
            resolves to this host (DNS rebinding).
        known_hosts: host names of the server. Numeric addresses are always accepted: they cannot resolve elsewhere.
    """
    if origin is None:
        return False
    try:
        site, name = urlsplit(origin).netloc, urlsplit(f"//{served_as or ''}").hostname or ""
    except ValueError:  # brackets that do not close
        return True
    if site != served_as:
        return True
    return not _is_numeric(name) and name not in {own.lower() for own in known_hosts}


def _is_numeric(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _note(faults: BurstLog, cause: str, detail: str) -> bool:
    """Log text from a browser in one line without control characters; return whether a burst begins."""
    return faults.note(cause, "".join(mark if mark.isprintable() else "?" for mark in detail[:_LONGEST_DETAIL]))


def _note_error(faults: BurstLog, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """Log the error of a task or callback of the server; with a traceback, once per burst, if no browser caused it."""
    error = context.get("exception")
    a_word_for_a_number = isinstance(error, ValueError) and str(error).startswith(_NO_NUMBER)
    if a_word_for_a_number or isinstance(error, (ConnectionError, WebSocketException)):
        _note(faults, REFUSED_MESSAGE, str(error))
    elif _note(faults, SERVER_ERROR, repr(error) if error else context["message"]):
        loop.default_exception_handler(context)


async def _watch(connection: ServerConnection) -> None:
    """Ping the browser and disconnect it without a response; the server's own pings queue behind unsent data."""
    try:
        while True:
            await asyncio.sleep(_ASKING)
            async with asyncio.timeout(PATIENCE):
                await (await connection.ping())
    except TimeoutError:
        connection.transport.abort()
