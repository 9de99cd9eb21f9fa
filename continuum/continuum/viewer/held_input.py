"""An input of the page that is reset when the browser that changed it disconnects."""

from __future__ import annotations

from typing import Any

import viser


class Held:
    """An input, shared by all browsers, that commands the arm while it is not at rest.

    Args:
        server: server of the page.
        handle: handle of the input.
        rest: value of the input at rest, at which it commands nothing.
    """

    def __init__(self, server: viser.ViserServer, handle: Any, rest: object) -> None:
        self._server = server
        self._handle = handle
        self._rest = rest
        self._by: int | None = None
        self._left = False
        handle.on_update(self._take)

    @property
    def value(self) -> Any:
        return self._handle.value

    def let_go(self) -> None:
        """Reset the input unless the browser that changed it last is still connected; to be called periodically.

        The input is reset only if the browser was also absent at the previous call, because the sender of a change
        becomes known slightly after the change.
        """
        left = self.value != self._rest and self._by not in self._server.get_clients()
        if left and self._left:
            self._handle.value = self._rest
        self._left = left

    async def _take(self, event: viser.GuiEvent[Any]) -> None:
        """Store the sender of a change; asynchronous, so that changes are processed in the order of arrival."""
        self._by = event.client_id
