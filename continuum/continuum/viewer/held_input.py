"""An input of the page that is in somebody's hand: it goes back to rest once that browser has left."""

from __future__ import annotations

from typing import Any

import viser


class Held:
    """One input, the same in all browsers, that moves the arm while it is not at rest.

    Args:
        server: of the page.
        handle: of the input.
        rest: its value when nothing is asked of the arm.
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
        """Put it to rest, unless the browser that changed it last is still there; to be called again and again.

        It must have been gone at the call before, too: who changes an input is known a moment later than the change.
        """
        left = self.value != self._rest and self._by not in self._server.get_clients()
        if left and self._left:
            self._handle.value = self._rest
        self._left = left

    async def _take(self, event: viser.GuiEvent[Any]) -> None:
        """Asynchronous so that takes are seen in the order in which they came."""
        self._by = event.client_id
