"""Who comes in by the page's address, and with what: browsers that show this very page, as long as they answer."""

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
"""A browser that gives no sign of life for so long is sent away [s]; one that lives comes again by itself."""

REFUSED_SITE = "page of another site"
REFUSED_MESSAGE = "message of a browser"
SERVER_ERROR = "error of the page's server"

_ASKING = 2.0
"""Between two questions whether a browser lives [s]."""

_LONGEST_DETAIL = 200
"""Characters of what a browser says that are repeated."""

_NO_NUMBER = "could not convert string to float"
"""What Python says of an input's value that is a word; for a number input, the server converts whatever it is sent."""

_Handler = Callable[[ServerConnection], Awaitable[None]]
_Answer = Callable[[ServerConnection, Request], Response | None]

_hung = threading.Lock()
"""One door is hung at a time."""


class NoOriginGuardError(ContinuumError):
    """The server of pages cannot be kept from letting everybody in."""


@contextmanager
def kept_guard(host: str, words: Collection[str], faults: BurstLog, title: str = NAME) -> Iterator[None]:
    """Let a server of pages that is started meanwhile let in only who shall, and only what a page sends.

    The server by itself would take orders from a page of any site that is open in a browser of this host, would let a
    browser change anything about an input or open a tunnel to a public address, and would wait for a browser that
    hangs until its end. It hands none of the hooks of `websockets` on (``process_request``, ``create_connection``), so
    the function that it calls to serve is another one while it starts.

    Args:
        host: address that the page is served on.
        words: that a browser may say; asked for whenever it speaks.
        faults: where it is noted who and what was refused.
        title: title of the page in the browser.

    Raises:
        NoDoorError: the server that was started serves in another way.
    """
    known_hosts = {host, "localhost", socket.gethostname(), f"{socket.gethostname()}.local"}
    serve = websocket_server.serve
    served = threading.Event()
    put_title = titled(title)

    class Connection(ServerConnection):
        """Gives messages that a page sends; others are noted."""

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
                await asyncio.gather(watch, return_exceptions=True)  # it may have met the end of the connection

        served.set()
        hooks = {"process_request": answer, "create_connection": Connection, "max_size": LONGEST}
        return serve(handle, host, port, **(options | hooks))

    with _hung:
        websocket_server.serve = serve_guarded  # type: ignore[assignment, misc]
        try:
            yield
        finally:
            websocket_server.serve = serve  # type: ignore[misc]
    if not served.is_set():
        raise NoOriginGuardError(
            "this version of viser lets everybody in; docs/dependencies.md names one that does not"
        )


def is_stranger(origin: str | None, served_as: str | None, known_hosts: set[str]) -> bool:
    """Whether a browser shows a page of another site.

    Args:
        origin: site of the page that connects, as the browser says; None of what is no browser.
        served_as: name and port by which it connects. A name that is not the server's own is of a site that points it
            at this host (DNS rebinding).
        own_names: names of the server. Numeric addresses are never strange: nobody can point them elsewhere.
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
    """What a browser says is repeated in one line without control characters. Whether a burst begins."""
    return faults.note(cause, "".join(mark if mark.isprintable() else "?" for mark in detail[:_LONGEST_DETAIL]))


def _note_error(faults: BurstLog, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """What ended a task or a callback of the server; what no browser did is logged with its traceback, once a burst."""
    error = context.get("exception")
    a_word_for_a_number = isinstance(error, ValueError) and str(error).startswith(_NO_NUMBER)
    if a_word_for_a_number or isinstance(error, (ConnectionError, WebSocketException)):
        _note(faults, REFUSED_MESSAGE, str(error))
    elif _note(faults, SERVER_ERROR, repr(error) if error else context["message"]):
        loop.default_exception_handler(context)


async def _watch(connection: ServerConnection) -> None:
    """Ask whether it lives; the server's own question waits behind all that a browser that hangs does not take."""
    try:
        while True:
            await asyncio.sleep(_ASKING)
            async with asyncio.timeout(PATIENCE):
                await (await connection.ping())
    except TimeoutError:
        connection.transport.abort()
