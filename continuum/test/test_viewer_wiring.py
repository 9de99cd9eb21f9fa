"""Buttons, inputs and keys of the page act when a browser sends their messages."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import msgspec
import numpy as np
import pytest
import viser
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from continuum.kinematics.chain import arm_pose
from continuum.viewer.default_arm import arm_of_joints, default_arm
from continuum.viewer.manual_source import ManualSource
from continuum.viewer.page import Page
from continuum.viewer.playback import Playback
from continuum.viewer.tracks import Track, Tracks

pytestmark = pytest.mark.slow

ARM = default_arm(2)
CAMERA = {
    "type": "ViewerCameraMessage", "wxyz": (1.0, 0.0, 0.0, 0.0), "position": (1.0, 0.0, 0.0), "fov": 1.0,
    "near": 0.01, "far": 100.0, "image_height": 600, "image_width": 800, "look_at": (0.0, 0.0, 0.0),
    "up_direction": (0.0, 0.0, 1.0),
}  # fmt: skip


class Browser:
    """A connection to a page, as a browser has it."""

    def __init__(self, page: Page, socket: ClientConnection) -> None:
        self.page, self._socket = page, socket
        self._gui = page._server.gui

    def send(self, **message: object) -> None:
        self._socket.send(msgspec.msgpack.encode(message))

    def set(self, label: str, value: object) -> None:
        """Send the value of the input with this label."""
        inputs = [one for one in self._gui._gui_input_handle_from_uuid.values() if one._impl.props.label == label]
        (handle,) = inputs
        self.send(type="GuiUpdateMessage", uuid=handle._impl.uuid, updates={"value": value})

    def press_key(self, name: str) -> None:
        """Send the command of a key."""
        commands = self._gui._command_handle_from_uuid.items()
        (uuid,) = (uuid for uuid, handle in commands if handle._impl.props.label == name)
        self.send(type="CommandTriggerMessage", uuid=uuid)

    def wait(self, condition: Callable[[], bool]) -> None:
        end = time.monotonic() + 30.0
        while not condition():
            assert time.monotonic() < end
            self.page.draw()
            time.sleep(0.005)


@contextmanager
def browser_of(page: Page) -> Iterator[Browser]:
    try:
        with connect(
            page.address.replace("http", "ws", 1),
            subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
            compression=None,
            max_size=None,
        ) as socket:
            browser = Browser(page, socket)
            browser.send(**CAMERA)
            browser.wait(lambda: page.browsers == 1)
            yield browser
    finally:
        page.close()


def test_the_arm_goes_to_the_typed_target_and_is_straightened() -> None:
    page = Page(ARM, ManualSource(ARM), port=0)
    with browser_of(page) as browser:
        page.draw()
        straight, wanted = page._scene.tip, arm_pose(np.array([[0.3, -0.2], [0.5, 0.4]]), ARM)[:3, 3]
        for axis, part in zip("xyz", wanted, strict=True):
            browser.set(f"{axis} [mm]", 1e3 * float(part))
        browser.set("", "Go to target")
        browser.wait(lambda: np.allclose(page._scene.tip, wanted, atol=1e-5))
        browser.set("", "Straighten")
        browser.wait(lambda: np.allclose(page._scene.tip, straight, atol=1e-6))


def test_the_view_is_darkened_and_reset() -> None:
    page = Page(ARM, ManualSource(ARM), port=0)
    with browser_of(page) as browser:
        browser.set("Dark", True)
        browser.wait(lambda: page._view.dark)
        (client,) = page._server.get_clients().values()
        first = np.array(page._server.initial_camera.position)
        assert not np.allclose(client.camera.position, first)
        browser.set("Reset view", True)
        browser.wait(lambda: np.allclose(client.camera.position, first))


def test_a_recording_is_saved_and_its_keys_play_and_step(monkeypatch: pytest.MonkeyPatch) -> None:
    saved: list[str] = []

    def save(_: object, filename: str, content: bytes, **__: object) -> None:
        saved.append(content.decode())

    monkeypatch.setattr(viser.ClientHandle, "send_file_download", save)
    names = ("section_1_theta_1", "section_1_theta_2")
    times = np.arange(5.0)
    source = Playback(arm_of_joints(names), Tracks(Track(times, names, np.zeros((5, 2)))), "run")
    page = Page(arm_of_joints(names), source, port=0)
    with browser_of(page) as browser:
        browser.set("Save CSV", True)
        browser.wait(lambda: bool(saved))
        assert len(saved[0].splitlines()) == 1 + times.size
        browser.press_key("Play or pause")
        browser.wait(lambda: not source.player.playing)
        browser.set("time [s]", 0.5)
        browser.wait(lambda: source.player._time == 0.5)
        for key, moment in (("Step forward", 1.0), ("Step forward", 2.0), ("Step back", 1.0)):
            browser.press_key(key)
            browser.wait(lambda moment=moment: source.player._time == moment)  # type: ignore[misc]
        browser.set("Step", "forward")
        browser.wait(lambda: source.player._time == 2.0)
