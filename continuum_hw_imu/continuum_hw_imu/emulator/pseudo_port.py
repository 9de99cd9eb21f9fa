"""An emulated serial port: a pseudo-terminal that can be unplugged and plugged in again like a USB port.

As with the DTR line of a port, the device detects whether a host has it open.
"""

from __future__ import annotations

import os
import select
import tty
from pathlib import Path

from continuum.errors import FileError

_MOST_WAITING = 1 << 14
"""Most bytes that wait for a host that does not read; further frames are dropped."""


class PseudoPort:
    """A pseudo-terminal as a serial port; it is initially plugged in.

    Args:
        link: path of a symbolic link to the port, which exists while the port is plugged in; None for no link.

    Attributes:
        name: name of the device file while the port is plugged in.
        dropped: number of frames that were dropped because the buffer was full.

    Raises:
        FileError: the path of the link is in use, or cannot be written.
    """

    def __init__(self, link: Path | None = None) -> None:
        self._link = link
        self._master: int | None = None
        self._waiting = bytearray()
        self.name = ""
        self.dropped = 0
        self.plug()

    def plug(self) -> None:
        """Create the port unless it exists."""
        if self._master is not None:
            return
        self._master, slave = os.openpty()
        try:
            tty.setraw(slave)
            self.name = os.ttyname(slave)
        finally:
            os.close(slave)  # now only hosts hold it, so that closing it is detected
        os.set_blocking(self._master, False)
        self._point_link()

    def unplug(self) -> None:
        """Remove the port and the data in transmission."""
        if self._master is None:
            return
        if self._link is not None and self._link.is_symlink():
            self._link.unlink()  # first: another process may take the name of its target as soon as it is free
        os.close(self._master)
        self._master = None
        self._waiting.clear()

    @property
    def plugged(self) -> bool:
        return self._master is not None

    @property
    def open(self) -> bool:
        """Whether a host has the port open."""
        if self._master is None:
            return False
        poll = select.poll()
        poll.register(self._master, select.POLLIN)
        return not any(events & select.POLLHUP for _, events in poll.poll(0))

    def fileno(self) -> int | None:
        """Return the file descriptor to wait for bytes; None while unplugged."""
        return self._master

    def forget(self) -> None:
        """Drop the data for a host that has closed the port; unread data in the port are lost with its end."""
        self._waiting.clear()

    def read(self) -> bytes:
        """Return the received bytes, b"" for none."""
        if self._master is None:
            return b""
        try:
            return os.read(self._master, 1 << 16)
        except OSError:  # no data, or no host
            return b""

    def write(self, frame: bytes) -> None:
        """Send a frame, or keep it until the host reads again; without a host it is lost."""
        if len(self._waiting) + len(frame) > _MOST_WAITING:
            self.dropped += 1
        else:
            self._waiting += frame
        self.flush()

    def flush(self) -> None:
        """Send as much of the waiting data as possible now."""
        if self._master is None or not self._waiting:
            return
        try:
            sent = os.write(self._master, self._waiting)
        except BlockingIOError:
            return
        except OSError:  # the host has just closed the port
            sent = len(self._waiting)
        del self._waiting[:sent]

    def _point_link(self) -> None:
        if self._link is None:
            return
        if self._link.exists():  # a link to a removed port is broken
            what = f"refers to {self._link.resolve()}, which is in use" if self._link.is_symlink() else "is not a link"
            raise FileError(self._link, f"exists already and {what}; give another --link, or end its owner")
        other = self._link.with_name(f".{self._link.name}.{os.getpid()}")
        try:
            other.unlink(missing_ok=True)
            other.symlink_to(self.name)
            other.replace(self._link)
        except OSError as error:
            raise FileError(self._link, f"cannot be created: {error.strerror}") from None
