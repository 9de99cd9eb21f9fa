"""The serial link on a pseudo-terminal that goes and comes: what arrives, what is told, who holds the port."""

import threading
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
import serial
from harness import wait_until

from continuum_hw_imu.emulator.pseudo_port import PseudoPort
from continuum_hw_imu.link.serial_link import CHECK, SerialLink


class Line:
    """A link, and all that it says."""

    def __init__(self, port) -> None:
        self.received, self.lost, self.times = b"", [], []
        self.link = SerialLink(str(port), 921_600, self._take, lost=self.lost.append)
        self.link.start()

    def _take(self, data: bytes, now: float) -> None:
        self.received += data
        self.times.append(now)


@contextmanager
def line_at(port):
    line = Line(port)
    try:
        yield line
    finally:
        line.link.close()


@pytest.fixture
def port(tmp_path):
    port = PseudoPort(tmp_path / "port")
    yield port
    port.unplug()


def test_bytes_go_both_ways(port, tmp_path):
    with line_at(tmp_path / "port") as line:
        wait_until(lambda: line.link.is_open, "the port")
        port.write(bytes(range(256)))
        wait_until(lambda: len(line.received) == 256, lambda: line.received)
        assert line.received == bytes(range(256))  # nothing is taken for a control character
        assert line.link.send(b"\x00\x11\x13\xff")
        wait_until(lambda: port.read() == b"\x00\x11\x13\xff", "bytes of the host")


def test_no_byte_is_said_to_have_come_before_it_was_sent(port, tmp_path, monkeypatch):
    """Even where the reading thread waits for the processor between two steps."""
    sent = []

    def write_meanwhile(serial):
        sent.append(time.monotonic())
        port.write(b"y")
        return waiting(serial)

    waiting = serial.Serial.in_waiting.fget
    monkeypatch.setattr(serial.Serial, "in_waiting", property(write_meanwhile))
    with line_at(tmp_path / "port") as line:
        wait_until(lambda: line.link.is_open, "the port")
        port.write(b"x")
        wait_until(lambda: line.received.startswith(b"xy"), lambda: line.received)
        assert line.times[0] >= sent[0]


def test_waiting_for_bytes_differs_from_waiting_for_the_processor(port, tmp_path):
    with line_at(tmp_path / "port") as line:
        wait_until(lambda: line.link.is_open, "the port")
        port.write(b"x")
        wait_until(lambda: line.times, "the byte")
        wait_until(lambda: line.link.emptied > line.times[-1] + 2 * CHECK, "that nothing more comes")


def test_a_line_that_never_pauses_is_emptied_between_its_bytes(port, tmp_path):
    """As a bad one, whose bytes are no frames: the bench is silent."""
    times, emptied = [], []
    lock = threading.Lock()  # the port is written to by one thread at a time

    def write(data: bytes) -> None:
        with lock:
            port.write(data)

    def take(data: bytes, now: float) -> None:
        times.append(now)
        emptied.append(link.emptied)
        write(data)

    link = SerialLink(str(tmp_path / "port"), 921_600, take)
    link.start()
    try:
        wait_until(lambda: link.is_open, "the port")
        write(b"x")
        wait_until(lambda: len(emptied) > 20, "bytes")
    finally:
        link.close()
    assert all(empty >= now for empty, now in zip(emptied[1:], times, strict=False))


def test_a_port_that_comes_later_or_back_is_opened(tmp_path):
    with line_at(tmp_path / "port") as line:
        wait_until(lambda: "does not exist" in line.link.problem, "a word about the missing port")
        assert not line.link.send(b"lost")
        port = PseudoPort(tmp_path / "port")
        for round_number in (1, 2, 3):
            wait_until(lambda: line.link.is_open, "the port")
            assert (line.link.openings, line.link.problem) == (round_number, "")
            port.write(b"%d" % round_number)
            wait_until(lambda n=round_number: line.received.endswith(b"%d" % n), "bytes")
            port.unplug()
            wait_until(lambda: not line.link.is_open, "the loss")
            if round_number < 3:
                port.plug()
        wait_until(lambda: len(line.lost) == 3, "a word about each loss")
    assert line.received == b"123"
    assert len(line.lost) == 3
    assert line.link.refused == 1


def test_one_process_holds_the_port(port, tmp_path):
    with line_at(tmp_path / "port") as first:
        wait_until(lambda: first.link.is_open, "the port")
        with line_at(tmp_path / "port") as second:
            wait_until(lambda: "is held by another process" in second.link.problem, lambda: second.link.problem)
            first.link.close()
            wait_until(lambda: second.link.is_open, "the port, once it is free")


def test_a_port_that_takes_nothing_does_not_hold_up_its_sender(port, tmp_path):
    with line_at(tmp_path / "port") as line:
        wait_until(lambda: line.link.is_open, "the port")
        sendings = 0
        while line.link.send(bytes(1000)):
            sendings += 1
            assert sendings < 1000
        assert line.link.refused == 1
        assert line.link.is_open


def test_what_is_no_port_is_reported(tmp_path):
    (tmp_path / "file").write_text("no port")
    with line_at(tmp_path / "file") as line:
        wait_until(lambda: "failed" in line.link.problem, lambda: line.link.problem)


def test_nothing_is_left_open(port, tmp_path):
    before = set(Path("/proc/self/fd").iterdir())
    with line_at(tmp_path / "port") as line:
        wait_until(lambda: line.link.is_open, "the port")
        port.unplug()
        wait_until(lambda: line.link.problem, "the loss")
        port.plug()
        wait_until(lambda: line.link.is_open, "the port")
    assert len(set(Path("/proc/self/fd").iterdir()) - before) == 0
