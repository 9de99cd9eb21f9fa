"""Who comes in by the page's address: browsers that show this very page, as long as they answer; no public one."""

from __future__ import annotations

import asyncio
import ipaddress
import socket
from typing import Any
from urllib.parse import urlsplit

import viser
from viser._messages import ShareUrlRequest
from viser.infra import WebsockClientConnection

PATIENCE = 10.0
"""A browser that gives no sign of life for so long is sent away [s]; one that lives comes again by itself."""

_ASKING = 2.0
"""Between two questions whether a browser lives [s]."""

_REFUSED = 1008
"""WebSocket's code for what is against the rules of a server."""


def keep_door(server: viser.ViserServer, host: str) -> None:
    """Let in only who shall.

    The server by itself would take orders from a page of any site that is open in a browser of this host, would on a
    browser's request open a tunnel to a public address, and would wait for a browser that hangs until its end.

    Args:
        server: of the page.
        host: address that it is served on.
    """
    door = server._websock_server
    door.unregister_handler(ShareUrlRequest)
    own_names = {host, "localhost", socket.gethostname(), f"{socket.gethostname()}.local"}
    watches: dict[int, asyncio.Task[None]] = {}

    async def on_connect(client: WebsockClientConnection) -> None:
        connection = door._live_connections[client.client_id]
        headers = connection.request.headers if connection.request is not None else {}
        if is_stranger(headers.get("Origin"), headers.get("Host"), own_names):
            await connection.close(_REFUSED, "a page of another site")
            return
        watches[client.client_id] = asyncio.create_task(_watch(connection))

    async def on_disconnect(client: WebsockClientConnection) -> None:
        watch = watches.pop(client.client_id, None)
        if watch is not None:
            watch.cancel()
            await asyncio.gather(watch, return_exceptions=True)  # it may have met the end of the connection

    door.on_client_connect(on_connect)
    door.on_client_disconnect(on_disconnect)
    door.disconnect_all_clients()  # of who came before there was a door


def is_stranger(origin: str | None, served_as: str | None, own_names: set[str]) -> bool:
    """Whether a browser shows a page of another site.

    Args:
        origin: site of the page that connects, as the browser says; None of what is no browser.
        served_as: name and port by which it connects. A name that is not the server's own is of a site that points it
            at this host (DNS rebinding).
        own_names: names of the server. Numeric addresses are never strange: nobody can point them elsewhere.
    """
    if origin is None:
        return False
    if served_as is None or urlsplit(origin).netloc != served_as:
        return True
    name = urlsplit(f"//{served_as}").hostname or ""
    return not _is_numeric(name) and name not in {own.lower() for own in own_names}


def _is_numeric(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


async def _watch(connection: Any) -> None:
    """Ask whether it lives; the server's own question waits behind all that a browser that hangs does not take."""
    try:
        while True:
            await asyncio.sleep(_ASKING)
            async with asyncio.timeout(PATIENCE):
                await (await connection.ping())
    except TimeoutError:
        connection.transport.abort()
