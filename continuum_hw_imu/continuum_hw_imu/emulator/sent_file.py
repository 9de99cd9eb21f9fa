"""When sound frames of the sensors were written to the port: one row for every one, to reckon delays with.

Columns: written_s (of this machine's monotonic clock, just after the bytes were handed to the port), device_time_us
(32 bit, as in the frame), sequence.
"""

from __future__ import annotations

import time
from pathlib import Path

from continuum_hw_imu.emulator.growing_file import GrowingFile
from continuum_hw_imu.protocol.decoder import Decoder
from continuum_hw_imu.protocol.messages import ImuFrame


class SentFile:
    """Frames that were spoiled on the line are no rows.

    Raises:
        FileError: it cannot be written, here or later.
    """

    def __init__(self, path: Path) -> None:
        self._file = GrowingFile(path)
        self._file.write("written_s,device_time_us,sequence\n")
        self._decoder = Decoder.of_host()

    def note(self, data: bytes) -> None:
        """Bytes were written just now."""
        now = time.monotonic()
        for frame in self._decoder.feed(data):
            if isinstance(frame.message, ImuFrame):
                self._file.write(f"{now:.6f},{frame.time},{frame.sequence}\n")

    def close(self) -> None:
        self._file.close()
