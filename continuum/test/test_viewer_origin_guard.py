"""Which browsers and messages the page admits; everything else is counted and has no effect."""

import contextlib
import time
from collections.abc import Callable, Iterator

import msgspec
import numpy as np
import pytest
import viser
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin, Subprotocol

from continuum.burst_log import BurstLog
from continuum.kinematics.chain import arm_pose
from continuum.viewer.browser_messages import LONGEST
from continuum.viewer.default_arm import default_arm
from continuum.viewer.origin_guard import NoOriginGuardError, kept_guard
from continuum.viewer.page import Page
from continuum.viewer.remote_arm import RemoteArm

ARM = default_arm(2)
PLACES = [arm_pose(np.full((2, 2), bend), ARM)[:3, 3].tolist() for bend in (0.1, 0.2)]
CAMERA = {
    "type": "ViewerCameraMessage", "wxyz": (1.0, 0.0, 0.0, 0.0), "position": (1.0, 0.0, 0.0), "fov": 1.0,
    "near": 0.01, "far": 100.0, "image_height": 600, "image_width": 800, "look_at": (0.0, 0.0, 0.0),
    "up_direction": (0.0, 0.0, 1.0),
}  # fmt: skip
NAN = float("nan")


def drag(**changes: object) -> dict[str, object]:
    message = {"name": "/target", "wxyz": (1.0, 0.0, 0.0, 0.0), "position": tuple(PLACES[1]), "owner": ""}
    return {"type": "TransformControlsUpdateMessage", **message, **changes}


class Served:
    """A page on which the target is the user's."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.faults = BurstLog(self.lines.append, time.monotonic)
        self.remote = RemoteArm(ARM, 30.0)
        self.page = Page(ARM, self.remote, port=0, faults=self.faults)
        self.remote.tell(tensions={ARM.cable_names[0]: 1.0})
        self.remote._leads._handle.value = "the target"
        self.page.draw()

    def client(self, origin: str | None = None) -> ClientConnection:
        return connect(
            self.page.address.replace("http", "ws", 1),
            subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
            origin=None if origin is None else Origin(origin),
            compression=None,
            max_size=None,
        )

    def wait(self, condition: Callable[[], bool]) -> None:
        end = time.monotonic() + 30.0
        while not condition():
            assert time.monotonic() < end, self.lines
            self.page.draw()
            time.sleep(0.005)

    def uuid(self, name: str) -> str:
        """Of an input of the page."""
        handles = {
            "Section": self.page._plots.plots.choice._handle,
            "theta": self.remote._controls._sliders[0].theta,
            "take": self.remote.tensions._taken._handle,
        }
        return handles[name]._impl.uuid

    def state(self) -> list[object]:
        """All that a browser may change."""
        controls, tensions = self.remote._controls, self.remote.tensions
        angles = controls._read().tolist()
        return [
            self.page._plots.plots.choice.value, controls._sliders[0].theta.visible, angles, tensions.taken,
            controls._gizmo.position.tolist(), self.remote.target.tolist(),
        ]  # fmt: skip

    def hears(self, client: ClientConnection, place: list[float]) -> None:
        """A target that is dragged is taken."""
        client.send(msgspec.msgpack.encode(drag(position=place)))
        self.wait(lambda: np.allclose(self.remote.target, place))


@pytest.fixture(scope="module")
def served() -> Iterator[Served]:
    served = Served()
    yield served
    served.page.close()


@pytest.mark.parametrize("origin", ["http://127.0.0.1:1", "http://evil.example", "null", "http://[::1"])
def test_a_page_of_another_site_is_refused_in_the_handshake(served: Served, origin: str) -> None:
    before = served.faults.counts["page of another site"]
    with pytest.raises(InvalidStatus) as refusal:
        served.client(origin)
    assert refusal.value.response.status_code == 403
    assert served.faults.counts["page of another site"] == before + 1


def test_a_server_that_is_served_in_another_way_is_refused(served: Served) -> None:
    with pytest.raises(NoOriginGuardError), kept_guard("127.0.0.1", (), served.faults):
        pass


def test_the_page_itself_and_programs_are_let_in(served: Served) -> None:
    for place, origin in zip(PLACES, (served.page.address, None), strict=True):
        with served.client(origin) as client:
            served.hears(client, place)


@pytest.mark.parametrize(
    "said",
    [
        drag(position=(0.1, 0.2)),
        drag(position=(0.1, 0.2, NAN)),
        drag(position=(0.1, 0.2, "0.3")),
        drag(position="abc"),
        drag(position=(1e3, 0.0, 0.0)),
        drag(wxyz=(NAN, 0.0, 0.0, 0.0)),
        drag(name=["/target"]),
        {"type": "TransformControlsUpdateMessage", "name": "/target"},
        CAMERA | {"position": (0.0, NAN, 0.0)},
        {"type": "ShareUrlRequest"},
        {"type": "CommandTriggerMessage"},
        {"type": "CommandTriggerMessage", "uuid": 3},
        {"type": "CommandTriggerMessage", "uuid": 300 * "a"},
        {"type": "CommandTriggerMessage", "uuid": "a", "name": "b"},
        {"type": "RunJavascriptMessage", "source": "alert(1)"},
        {"type": "no such"},
        {"no": "type"},
        [1, 2],
        None,
    ],
    ids=repr,
)
def test_what_no_page_says_is_counted_and_changes_nothing(served: Served, said: object) -> None:
    refused(served, msgspec.msgpack.encode(said))


@pytest.mark.parametrize(
    "said",
    [
        CAMERA,
        drag(),
        {"type": "TransformControlsDragStartMessage", "name": "/target"},
        {"type": "TransformControlsDragEndMessage", "name": "/target"},
        {"type": "CommandTriggerMessage", "uuid": "of a command that was removed"},
    ],
    ids=repr,
)
def test_what_a_page_says_is_let_in(served: Served, said: object) -> None:
    with served.client() as client:
        client.send(msgspec.msgpack.encode(CAMERA))
        served.hears(client, PLACES[0])
        before = served.faults.total
        client.send(msgspec.msgpack.encode(said))
        served.hears(client, PLACES[1])
        served.hears(client, PLACES[0])
        assert served.faults.total == before


@pytest.mark.parametrize("data", [b"", b"\xc1", b"\xdc\xff\xff", "text", "\x1b[31m"], ids=repr)
def test_what_is_no_message_is_counted_and_changes_nothing(served: Served, data: bytes | str) -> None:
    refused(served, data)


@pytest.mark.parametrize(
    ("name", "updates"),
    [
        ("theta", {"value": NAN}),
        ("theta", {"value": "nan"}),
        ("theta", {"value": None}),
        ("theta", {"removed": True}),
        ("theta", {"update_cb": "x"}),
        ("theta", {}),
        ("theta", []),
        ("Section", {"value": "nan"}),
        ("Section", {"value": 3}),
        ("Section", {"options": []}),
        ("take", {"value": "no"}),
        ("take", {"update_timestamp": NAN}),
    ],
    ids=repr,
)
def test_what_no_input_says_is_counted_and_changes_nothing(served: Served, name: str, updates: object) -> None:
    message = {"type": "GuiUpdateMessage", "uuid": served.uuid(name), "updates": updates}
    refused(served, msgspec.msgpack.encode(message))


def test_the_section_to_plot_is_chosen(served: Served) -> None:
    with served.client() as client:
        for section in ("section 2", "section 1"):
            said = {"type": "GuiUpdateMessage", "uuid": served.uuid("Section"), "updates": {"value": section}}
            client.send(msgspec.msgpack.encode(said))
            served.wait(lambda section=section: served.page._plots.plots.choice.value == section)


def test_what_is_repeated_of_browsers_is_one_printable_line(served: Served) -> None:
    with served.client() as client:
        client.send(msgspec.msgpack.encode({"type": "a\n\x1b[31m" + 1000 * "b"}))
        served.hears(client, PLACES[0])
    assert all(line.isprintable() and len(line) < 300 for line in served.lines)


def test_what_is_too_long_ends_the_connection_alone(served: Served) -> None:
    with served.client() as client:
        client.send(bytes(LONGEST + 1))
        with contextlib.suppress(ConnectionClosed):
            for _ in client:
                pass
        assert client.close_code == 1009
    with served.client() as client:
        served.hears(client, PLACES[0])


def counts_of_errors(served: Served, error: Exception) -> list[int]:
    """How many more events of browsers and of the server there are when its event loop met the error three times."""

    def failing_step() -> None:
        raise error

    causes = ("message of a browser", "error of the page's server")
    with served.client() as client:
        served.hears(client, PLACES[0])
        before, total = served.faults.counts, served.faults.total
        for _ in range(3):
            served.page._server.get_event_loop().call_soon_threadsafe(failing_step)
        served.wait(lambda: served.faults.total == total + 3)
        served.hears(client, PLACES[1])
    return [served.faults.counts[cause] - before[cause] for cause in causes]


def test_an_error_of_the_server_is_none_of_a_browser_and_its_traceback_is_logged_once_a_burst(
    served: Served, caplog: pytest.LogCaptureFixture
) -> None:
    assert counts_of_errors(served, ValueError("a bug")) == [0, 3]
    assert caplog.text.count("in failing_step") == 1


def test_a_broken_connection_is_none_of_the_server(served: Served, caplog: pytest.LogCaptureFixture) -> None:
    assert counts_of_errors(served, ConnectionResetError("gone")) == [3, 0]
    assert "failing_step" not in caplog.text


def refused(served: Served, data: bytes | str) -> None:
    """The page counts the message and goes on as if there had been none."""
    with served.client() as client:
        client.send(msgspec.msgpack.encode(CAMERA))
        served.hears(client, PLACES[0])
        before, count, errors = served.state(), served.faults.total, served.faults.counts["error of the page's server"]
        client.send(data)
        served.wait(lambda: served.faults.total > count)
        served.page._plots.plots.draw_soon()
        served.page.draw()
        assert served.state() == before
        served.hears(client, PLACES[1])
        assert served.faults.total == count + 1
        assert served.faults.counts["error of the page's server"] == errors
