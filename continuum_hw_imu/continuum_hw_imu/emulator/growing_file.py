"""A text file that is written line by line, so that it can be read while it grows."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from continuum.errors import FileError


class GrowingFile:
    """Empty at first; what was there before is lost.

    Args:
        path: of the file.

    Raises:
        FileError: it cannot be written, here or later.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._file = path.open("w", newline="", buffering=1, encoding="utf-8")
        except OSError as error:
            raise FileError(path, f"cannot be written ({error.strerror})") from error

    def write(self, text: str) -> None:
        """Add a line with its end, or several."""
        try:
            self._file.write(text)
        except OSError as error:
            raise FileError(self._path, f"cannot be written ({error.strerror})") from error

    def close(self) -> None:
        """End the file; a line that could not be written was reported then."""
        with suppress(OSError):
            self._file.close()
