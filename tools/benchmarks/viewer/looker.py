"""``python3 -m tools.benchmarks.viewer.looker ADDRESS``: receives all data of a page like a browser, without drawing.

A browser with software rendering would need more processor time than everything that is measured.
"""

from __future__ import annotations

import sys

import msgspec
import viser
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Subprotocol

CAMERA = {
    "type": "ViewerCameraMessage", "wxyz": (1.0, 0.0, 0.0, 0.0), "position": (1.0, 0.0, 0.0), "fov": 1.0,
    "near": 0.01, "far": 100.0, "image_height": 600, "image_width": 800, "look_at": (0.0, 0.0, 0.0),
    "up_direction": (0.0, 0.0, 1.0),
}  # fmt: skip
"""First message of a browser."""


def main() -> None:
    """Receive data until the page ends."""
    address = sys.argv[1].replace("http", "ws")
    protocol = Subprotocol(f"viser-v{viser.__version__}")
    with connect(address, subprotocols=[protocol], compression=None, max_size=None) as socket:
        socket.send(msgspec.msgpack.encode(CAMERA))
        try:
            for _ in socket:
                pass
        except ConnectionClosed:
            return


if __name__ == "__main__":
    main()
