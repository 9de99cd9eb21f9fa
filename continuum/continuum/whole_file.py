"""A file that is there as a whole or not at all: what was there before stays until the new one is written."""

from __future__ import annotations

import errno
import os
import shutil
from pathlib import Path

from continuum.errors import FileError

_NO_PLACE_BESIDE = (errno.EACCES, errno.EPERM, errno.EROFS, errno.EBUSY)
"""A folder that one may not write to, or a file that is mounted by itself."""


def write_whole(path: str | Path, text: str) -> None:
    """Write a file, in UTF-8, in place of one that may be there; a pipe or a terminal is written to as it is.

    Raises:
        FileError: it cannot be written.
    """
    try:
        file = Path(path)
        if file.exists() and not file.is_file():
            file.write_text(text, encoding="utf-8")
        else:
            _write_in_place(file.resolve(), text)
    except OSError as error:
        raise FileError(path, f"cannot be written ({error.strerror or error})") from error
    except UnicodeError as error:
        raise FileError(path, f"cannot be written ({error})") from error


def _write_in_place(file: Path, text: str) -> None:
    try:
        _write_beside(file, text)
    except OSError as error:
        if error.errno not in _NO_PLACE_BESIDE or not file.exists():
            raise
        file.write_text(text, encoding="utf-8")


def _write_beside(file: Path, text: str) -> None:
    beside = file.with_name(f".{file.name}.{os.getpid()}")
    try:
        beside.write_text(text, encoding="utf-8")
        if file.exists():
            shutil.copymode(file, beside)
        beside.replace(file)
    finally:
        beside.unlink(missing_ok=True)
