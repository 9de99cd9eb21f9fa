"""A text file that is written line by line and can be read while it grows."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from continuum.errors import FileError


class GrowingFile:
    """A growing text file; existing content is overwritten.

    Args:
        path: path of the file.

    Raises:
        FileError: the file cannot be written, now or later.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._file = path.open("w", newline="", buffering=1, encoding="utf-8")
        except OSError as error:
            raise FileError(path, f"cannot be written ({error.strerror})") from error

    def write(self, text: str) -> None:
        """Append one or several complete lines."""
        try:
            self._file.write(text)
        except OSError as error:
            raise FileError(self._path, f"cannot be written ({error.strerror})") from error

    def close(self) -> None:
        """Close the file; failures to write were reported by `write`."""
        with suppress(OSError):
            self._file.close()
