"""How files are written: as a whole or not at all; what was there before stays until the new one is complete."""

from __future__ import annotations

import csv
import errno
import io
import os
import secrets
import shutil
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from continuum.errors import FileError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_NO_PLACE_IN_FOLDER = (errno.EACCES, errno.EPERM, errno.EROFS, errno.EBUSY)
"""A folder that one may not write to, or a file that is mounted by itself."""

_NO_GLYPH = r"Glyph \d+ .*missing from "
"""Matplotlib's warning of a character that its font does not have."""


def write_whole(path: str | Path, content: str | bytes) -> None:
    """Write a file, text in UTF-8, in place of one that may be there, by a temporary file in the same folder.

    A full disk leaves the file that was there. A symbolic link stays one: what it points to is written, also where that
    is not there yet. A pipe or a terminal is written to as it is.

    Raises:
        FileError: it cannot be written.
    """
    try:
        data = content.encode("utf-8") if isinstance(content, str) else content
        file = target_of(path)
        if file.exists() and not file.is_file():
            file.write_bytes(data)
        else:
            _write_in_place(file, data)
    except OSError as error:
        raise FileError(path, f"cannot be written ({error.strerror or error})") from error
    except UnicodeError as error:
        raise FileError(path, f"cannot be written ({error})") from error


def write_table(path: str | Path, rows: Iterable[Iterable[object]]) -> None:
    """Write a CSV file, the names of its columns being the first row.

    Raises:
        FileError: it cannot be written.
    """
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    write_whole(path, text.getvalue())


def write_figure(path: str | Path, figure: Figure, dpi: int) -> None:
    """Write a picture in the format that the suffix names, PNG without one.

    A character of a name that Matplotlib's font does not have is drawn as an empty box, without a warning.

    Raises:
        FileError: it cannot be written, or Matplotlib does not know the format.
    """
    picture = io.BytesIO()
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", _NO_GLYPH, UserWarning)
            figure.savefig(picture, format=Path(path).suffix.removeprefix(".").lower() or "png", dpi=dpi)
    except ValueError as error:
        raise FileError(path, f"cannot be drawn ({error})") from error
    write_whole(path, picture.getvalue())


def target_of(path: str | Path) -> Path:
    """The file that is meant: what a symbolic link points to, whether it is there or not.

    Raises:
        FileError: links lead round a circle.
    """
    file = Path(os.path.realpath(path))
    if file.is_symlink():
        raise FileError(path, "is a symbolic link that leads back to itself")
    return file


def _write_in_place(file: Path, data: bytes) -> None:
    try:
        _write_and_rename(file, data)
    except OSError as error:
        if error.errno not in _NO_PLACE_IN_FOLDER or not file.exists():
            raise
        file.write_bytes(data)


def _write_and_rename(file: Path, data: bytes) -> None:
    temporary = file.with_name(f".continuum.{secrets.token_hex(8)}")
    try:
        with temporary.open("xb") as opened:
            opened.write(data)
            opened.flush()
            os.fsync(opened.fileno())  # some disks say only now that they are full
        if file.exists():
            shutil.copymode(file, temporary)
        temporary.replace(file)
    finally:
        temporary.unlink(missing_ok=True)
