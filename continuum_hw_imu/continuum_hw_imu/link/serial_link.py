"""A serial port that comes and goes: read by a thread of its own, opened again by itself, held by one process."""

from __future__ import annotations

import termios
import threading
import time
from collections.abc import Callable
from pathlib import Path

import serial

FIRST_PAUSE, LONGEST_PAUSE = 0.05, 0.4
"""Time between two attempts to open the port [s]: doubled from the first up to the longest."""

CHECK = 0.1
"""Longest wait for bytes before the thread looks whether it is to end [s]."""

WRITE_LIMIT = 0.02
"""Longest that sending may take [s]; then the other end does not read, and what was to be sent is old."""

MOST = 4096
"""Bytes taken at once."""

FAILURES = (serial.SerialException, OSError, termios.error)
"""What a port that goes away in the midst of anything raises."""

Received = Callable[[bytes, float], None]
"""Is given bytes and the instant at which they were there, of `time.monotonic` [s]."""


class SerialLink:
    """Bytes in and out of a serial port, from :meth:`start` to :meth:`close`.

    The port is opened whenever it is there and nobody else holds it, also when it comes back under its name after it
    was gone. All callables are called by the link's thread; what they raise ends it.

    Args:
        port: name of the device, e.g. ``/dev/ttyACM0``, or a symbolic link to it.
        baud_rate: [bit/s]
        received: is given what comes.
        opened: is told that the port is open: whatever was said before is forgotten at the other end.
        lost: is told why an open port is no more.

    Attributes:
        openings: how often the port was opened.
        refused: sendings that the port did not take.
        problem: why the port is not open, in words; empty while it is.
    """

    def __init__(
        self,
        port: str,
        baud_rate: int,
        received: Received,
        opened: Callable[[], None] = lambda: None,
        lost: Callable[[str], None] = lambda _problem: None,
    ) -> None:
        self._port, self._baud_rate = port, baud_rate
        self._received, self._opened, self._lost = received, opened, lost
        self._serial: serial.Serial | None = None
        self._mutex = threading.Lock()  # nobody writes to a port that is being closed
        self._again = threading.Event()
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._run, name="serial link", daemon=True)
        self.openings = 0
        self.refused = 0
        self.problem = "not opened yet"

    def start(self) -> None:
        """Begin; to be called once."""
        self._thread.start()

    def close(self) -> None:
        """Close the port and end the thread; a second call does nothing."""
        self._end.set()
        if self._thread.is_alive() and self._thread is not threading.current_thread():
            self._thread.join()

    def reopen(self) -> None:
        """Close the port and open it again: another device may have its name by now."""
        self._again.set()

    @property
    def is_open(self) -> bool:
        return self._serial is not None

    def send(self, data: bytes) -> bool:
        """Give bytes to the port; False if it did not take all of them, which is counted."""
        with self._mutex:
            try:
                if self._serial is not None and self._serial.write(data) == len(data):
                    return True
            except FAILURES:
                pass  # the reading thread finds out why, and opens it again
        self.refused += 1
        return False

    def _run(self) -> None:
        pause = FIRST_PAUSE
        try:
            while not self._end.is_set():
                if self._open():
                    pause = FIRST_PAUSE
                    self._read_on()
                self._end.wait(pause)
                pause = min(2.0 * pause, LONGEST_PAUSE)
        finally:
            self._shut("closed")

    def _open(self) -> bool:
        try:
            port = serial.Serial(self._port, self._baud_rate, timeout=CHECK, write_timeout=WRITE_LIMIT, exclusive=True)
        except (*FAILURES, ValueError) as error:
            self.problem = _in_words(self._port, error)
            return False
        self._again.clear()
        self.openings += 1
        with self._mutex:
            self.problem, self._serial = "", port
        self._opened()
        return True

    def _read_on(self) -> None:
        """Read until the port fails, or is to be opened again, or the link ends."""
        port = self._serial
        problem = "opened again, since it was silent"
        try:
            while port is not None and not (self._end.is_set() or self._again.is_set()):
                data = port.read(1)
                now = time.monotonic()
                if data:
                    self._received(data + port.read(min(port.in_waiting, MOST)), now)
        except FAILURES as error:
            problem = _in_words(self._port, error)
        self._shut(problem)
        if not self._end.is_set():
            self._lost(problem)

    def _shut(self, problem: str) -> None:
        with self._mutex:
            port, self._serial = self._serial, None
            self.problem = problem
        if port is not None:
            port.close()


def _in_words(port: str, error: Exception) -> str:
    """Why a port cannot be used, without Python's own words around the reason."""
    if not Path(port).exists():
        return f"{port} is not there"
    reason = str(error).lower()
    if "exclusively lock" in reason:
        return f"{port} is held by another process"
    if "permission denied" in reason:
        return f"{port} may not be opened by this user; add the user to the port's group (dialout)"
    if isinstance(error, ValueError):
        return f"{port}: {error}"
    return f"{port} failed ({error.__class__.__name__})"
