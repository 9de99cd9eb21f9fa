"""The viewer beside the demo: at its usual port, unless somebody else has that."""

import socket

import pytest

from continuum.viewer.address import HOST
from tools.demo import viewer


def test_usual_port_is_taken_while_it_is_free(monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.socket() as other:
        other.bind((HOST, 0))
        other.listen()
        usual = other.getsockname()[1]
        monkeypatch.setattr(viewer, "PORT", usual)
        assert viewer.port() == 0
    assert viewer.port() == usual
