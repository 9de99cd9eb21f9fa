"""A serial port that may disappear and return: read by a thread, reopened automatically, locked by one process."""

from __future__ import annotations

import termios
import threading
import time
from collections.abc import Callable
from pathlib import Path

import serial

FIRST_PAUSE, LONGEST_PAUSE = 0.05, 0.4
"""First and longest time between attempts to open the port [s]; it doubles from attempt to attempt."""

CHECK = 0.05
"""Longest wait for bytes before the thread checks whether it must end, and notes that there are none [s]."""

WRITE_LIMIT = 0.02
"""Longest duration of a transmission [s]; after that, the other end does not read, and the data are outdated."""

MOST = 4096
"""Most bytes read at once."""

FAILURES = (serial.SerialException, OSError, termios.error)
"""Exceptions of a port that disappears during an operation."""

Received = Callable[[bytes, float], None]
"""Function that is called with bytes and a time by `time.monotonic` [s] by which all of them had arrived."""


class SerialLink:
    """Input and output of a serial port, from :meth:`start` to :meth:`close`.

    The port is opened whenever it exists and no other process holds it, also when it returns under its name. The link's
    thread calls all callbacks; an exception in one ends the thread.

    Args:
        port: name of the device, e.g. ``/dev/ttyACM0``, or a symbolic link to it.
        baud_rate: [bit/s]
        received: called with received bytes.
        opened: called when the port was opened: the other end has no memory of earlier messages.
        lost: called with the reason when an open port was lost.

    Attributes:
        openings: number of times that the port was opened.
        refused: number of transmissions that the port did not accept.
        problem: description of why the port is not open; empty while it is.
        emptied: latest time by `time.monotonic` [s] at which the port had nothing to read.
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
        self._mutex = threading.Lock()  # prevents writing to a port that is being closed
        self._again = threading.Event()
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._run, name="serial link", daemon=True)
        self.openings = 0
        self.refused = 0
        self.problem = "not opened yet"
        self.emptied = 0.0

    def start(self) -> None:
        """Start the thread; call this once."""
        self._thread.start()

    def close(self) -> None:
        """Close the port and end the thread; a second call does nothing."""
        self._end.set()
        if self._thread.is_alive() and self._thread is not threading.current_thread():
            self._thread.join()

    def reopen(self) -> None:
        """Close the port and open it again: its name may now belong to another device."""
        self._again.set()

    @property
    def is_open(self) -> bool:
        return self._serial is not None

    def send(self, data: bytes) -> bool:
        """Write bytes to the port; count a failure and return False if the port did not accept all of them."""
        with self._mutex:
            try:
                if self._serial is not None and self._serial.write(data) == len(data):
                    return True
            except FAILURES:
                pass  # the reading thread finds the reason, and reopens the port
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
        """Read until the port fails, must be reopened, or the link ends."""
        port = self._serial
        problem = "reopened because it was silent"
        try:
            while port is not None and not (self._end.is_set() or self._again.is_set()):
                data = port.read(1)
                if data:
                    data += port.read(min(port.in_waiting, MOST))
                now = time.monotonic()  # last: whoever waits for the processor here must not take a byte for earlier
                emptied = not data or not port.in_waiting
                if data:
                    self._received(data, now)
                if emptied:
                    self.emptied = now  # only now: what was received is no silence up to then
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
    """Describe why a port cannot be used, without the wording of Python's exceptions."""
    if not Path(port).exists():
        return f"{port} does not exist"
    reason = str(error).lower()
    if "exclusively lock" in reason:
        return f"{port} is held by another process"
    if "permission denied" in reason:
        return f"{port} cannot be opened by this user; add the user to the port's group (dialout)"
    if isinstance(error, ValueError):
        return f"{port}: {error}"
    return f"{port} failed ({error.__class__.__name__})"
