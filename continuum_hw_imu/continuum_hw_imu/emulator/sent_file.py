"""Record of the times at which undamaged sensor frames were written to the port, one row each, to measure delays.

Columns: written_s (this machine's monotonic clock, just after the bytes were passed to the port), device_time_us
(32 bit, as in the frame), sequence.
"""

from __future__ import annotations

import time
from pathlib import Path

from continuum_hw_imu.emulator.growing_file import GrowingFile
from continuum_hw_imu.protocol.decoder import Decoder
from continuum_hw_imu.protocol.messages import ImuFrame


class SentFile:
    """Record without the frames that were damaged on the line.

    Raises:
        FileError: the file cannot be written, now or later.
    """

    def __init__(self, path: Path) -> None:
        self._file = GrowingFile(path)
        self._file.write("written_s,device_time_us,sequence\n")
        self._decoder = Decoder.of_host()

    def note(self, data: bytes) -> None:
        """Record bytes that were just written."""
        now = time.monotonic()
        for frame in self._decoder.feed(data):
            if isinstance(frame.message, ImuFrame):
                self._file.write(f"{now:.6f},{frame.time},{frame.sequence}\n")

    def close(self) -> None:
        self._file.close()
