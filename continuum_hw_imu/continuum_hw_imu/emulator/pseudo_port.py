"""A serial port that is none: a pseudo-terminal, which can be pulled out and put back as a USB port can.

As with the port's own line DTR, it is seen whether a host has it open.
"""

from __future__ import annotations

import os
import select
import tty
from pathlib import Path

from continuum.errors import FileError

_MOST_WAITING = 1 << 14
"""Bytes that wait for a host that does not read; whole frames beyond it are dropped."""


class PseudoPort:
    """Plugged in at first.

    Args:
        link: where a symbolic link to it is kept while it is plugged in; none without.

    Attributes:
        name: of the device file, while it is plugged in.
        dropped: number of frames that did not fit any more.

    Raises:
        FileError: the link's place is taken by something else, or cannot be written.
    """

    def __init__(self, link: Path | None = None) -> None:
        self._link = link
        self._master: int | None = None
        self._waiting = bytearray()
        self.name = ""
        self.dropped = 0
        self.plug()

    def plug(self) -> None:
        """Make the port, unless it is there."""
        if self._master is not None:
            return
        self._master, slave = os.openpty()
        try:
            tty.setraw(slave)
            self.name = os.ttyname(slave)
        finally:
            os.close(slave)  # now only hosts hold it, and it is seen when they let go
        os.set_blocking(self._master, False)
        self._point_link()

    def unplug(self) -> None:
        """The port goes, with whatever was under way in it."""
        if self._master is None:
            return
        if self._link is not None and self._link.is_symlink():
            self._link.unlink()  # first: the name that it leads to may be another's the moment that it is free
        os.close(self._master)
        self._master = None
        self._waiting.clear()

    @property
    def plugged(self) -> bool:
        return self._master is not None

    @property
    def open(self) -> bool:
        """Whether a host has it open."""
        if self._master is None:
            return False
        poll = select.poll()
        poll.register(self._master, select.POLLIN)
        return not any(events & select.POLLHUP for _, events in poll.poll(0))

    def fileno(self) -> int | None:
        """To wait for bytes with; None while it is unplugged."""
        return self._master

    def forget(self) -> None:
        """Drop what waits for a host that has gone; what it had not read, went with its end of the port."""
        self._waiting.clear()

    def read(self) -> bytes:
        """What has come, b"" for nothing."""
        if self._master is None:
            return b""
        try:
            return os.read(self._master, 1 << 16)
        except OSError:  # nothing there, or no host
            return b""

    def write(self, frame: bytes) -> None:
        """Send a frame, or keep it until the host reads on; without a host it is lost."""
        if len(self._waiting) + len(frame) > _MOST_WAITING:
            self.dropped += 1
        else:
            self._waiting += frame
        self.flush()

    def flush(self) -> None:
        """Send what waits, as far as it goes now."""
        if self._master is None or not self._waiting:
            return
        try:
            sent = os.write(self._master, self._waiting)
        except BlockingIOError:
            return
        except OSError:  # the host has just gone
            sent = len(self._waiting)
        del self._waiting[:sent]

    def _point_link(self) -> None:
        if self._link is None:
            return
        if self._link.exists():  # of a port that is gone it leads nowhere
            what = f"leads to {self._link.resolve()}, which is in use" if self._link.is_symlink() else "is no link"
            raise FileError(self._link, f"is there already, and {what}; give another --link, or end what made it")
        other = self._link.with_name(f".{self._link.name}.{os.getpid()}")
        try:
            other.unlink(missing_ok=True)
            other.symlink_to(self.name)
            other.replace(self._link)
        except OSError as error:
            raise FileError(self._link, f"cannot be made: {error.strerror}") from None
