"""Somebody at the viewer's page without a browser: takes what a page is sent, and says what a browser would."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from types import TracebackType
from typing import Any

import msgspec
import viser
import zstandard
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Origin, Subprotocol

from harness.waiting import wait_until
from tools.benchmarks.viewer.looker import CAMERA


class Visitor:
    """Use as a context.

    Args:
        address: of the page.
        origin: site of the page that connects; None as a program that is no browser.

    Attributes:
        shown: names of what is to be seen in the scene.
        texts: contents of the panels' texts, by their identity.

    Raises:
        InvalidStatus: the page is refused.
    """

    def __init__(self, address: str, origin: str | None = None) -> None:
        self._inputs: dict[str, list[str]] = {}
        self.shown: set[str] = set()
        self.texts: dict[str, str] = {}
        self._socket = connect(
            address.replace("http", "ws", 1),
            subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
            origin=None if origin is None else Origin(origin),
            compression=None,
            max_size=None,
        )
        self._taking = threading.Thread(target=self._take, daemon=True)
        self._taking.start()

    def __enter__(self) -> Visitor:
        self.say(CAMERA)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None):
        self._socket.close()
        self._taking.join()

    def say(self, message: Mapping[str, Any]) -> None:
        self._socket.send(msgspec.msgpack.encode(message))

    def put(self, label: str, value: object, which: int = 0) -> None:
        """Change the input of this label; of several alike, the one of this number."""
        wait_until(lambda: len(self._inputs.get(label, ())) > which, lambda: f"{label}, {which}: {self._inputs}")
        self.say({"type": "GuiUpdateMessage", "uuid": self._inputs[label][which], "updates": {"value": value}})

    def drag(self, position: Sequence[float]) -> None:
        """Put the target to (3,) [m]."""
        place = {"name": "/target", "wxyz": (1.0, 0.0, 0.0, 0.0), "position": tuple(map(float, position)), "owner": ""}
        self.say({"type": "TransformControlsUpdateMessage", **place})

    def _take(self) -> None:
        try:
            for data in self._socket:
                self._read(data)
        except ConnectionClosed:
            return

    def _read(self, data: bytes) -> None:
        """Eight bytes of a length, eight of another, then messages of that length, compressed; then arrays."""
        length = int.from_bytes(data[8:16], "little")
        content = msgspec.msgpack.decode(zstandard.ZstdDecompressor().decompress(data[16 : 16 + length]))
        for message in content["messages"]:
            kind, props = message["type"], message.get("props", {}) | message.get("updates", {})
            if kind == "SetSceneNodeVisibilityMessage":
                (self.shown.add if message["visible"] else self.shown.discard)(message["name"])
            elif kind.startswith("Gui") and "content" in props:
                self.texts[message["uuid"]] = props["content"]
            elif (
                kind.startswith("Gui")
                and "label" in props
                and message["uuid"] not in self._inputs.setdefault(props["label"], [])
            ):
                self._inputs[props["label"]].append(message["uuid"])
