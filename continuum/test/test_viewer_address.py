"""The page's address, and who comes in by it."""

import socket

import pytest

from continuum.errors import InvalidValueError
from continuum.viewer.address import url
from continuum.viewer.default_arm import default_arm
from continuum.viewer.manual_source import ManualSource
from continuum.viewer.origin_guard import is_stranger
from continuum.viewer.page import Page

ARM = default_arm(2)


def test_port_that_is_taken_is_refused():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(InvalidValueError, match=f"127.0.0.1:{port}.*--port 0.*port:=0"):
            Page(ARM, ManualSource(ARM), port=port)


@pytest.mark.parametrize(
    ("host", "opened_by"), [("127.0.0.1", "127.0.0.1"), ("::1", "[::1]"), ("0.0.0.0", "localhost"), ("::", "localhost")]
)
def test_address_is_one_that_a_browser_opens(host, opened_by):
    assert url(host, 8080) == f"http://{opened_by}:8080"


@pytest.mark.parametrize(("host", "port"), [("198.51.100.1", 0), ("127.0.0.1", 65536), ("no such host", 0)])
def test_address_that_is_none_of_this_machine_is_refused(host, port):
    with pytest.raises(InvalidValueError, match="allowed"):
        Page(ARM, ManualSource(ARM), host, port)


@pytest.mark.parametrize(
    ("origin", "served_as", "strange"),
    [
        (None, "127.0.0.1:8080", False),
        ("http://127.0.0.1:8080", "127.0.0.1:8080", False),
        ("http://192.0.2.7:8080", "192.0.2.7:8080", False),
        ("http://[::1]:8080", "[::1]:8080", False),
        ("http://bench:8080", "Bench:8080", True),  # browsers send it in small letters
        ("http://evil.example", "127.0.0.1:8080", True),
        ("http://rebound.example:8080", "rebound.example:8080", True),
        ("null", "127.0.0.1:8080", True),
        ("http://[::1", "[::1]:8080", True),
        ("http://127.0.0.1:8080, http://127.0.0.1:8080", "127.0.0.1:8080", True),  # said twice
        ("http://127.0.0.1:8080", None, True),
    ],
)
def test_pages_of_other_sites_are_strangers(origin, served_as, strange):
    assert is_stranger(origin, served_as, {"localhost", "Bench"}) is strange
