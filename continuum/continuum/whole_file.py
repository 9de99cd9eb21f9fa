"""Write files atomically: an existing file stays unchanged until the new one is complete."""

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
"""Error numbers of a folder without write permission, or of a file that is a mount point."""

_NO_GLYPH = r"Glyph \d+ .*missing from "
"""Matplotlib's warning of a character that its font does not have."""


def write_whole(path: str | Path, content: str | bytes) -> None:
    """Write a file, text in UTF-8, through a temporary file in the same folder that replaces an existing file.

    If the disk is full, the existing file remains. A symbolic link is preserved: its target is written, even if it does
    not exist yet. Pipes and terminals are written to directly.

    Raises:
        FileError: the file cannot be written.
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
    """Write a CSV file whose first row holds the names of the columns.

    Raises:
        FileError: the file cannot be written.
    """
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    write_whole(path, text.getvalue())


def write_figure(path: str | Path, figure: Figure, dpi: int) -> None:
    """Write a picture in the format of the suffix, or PNG without a suffix.

    Characters that Matplotlib's font lacks are drawn as empty boxes, without a warning.

    Raises:
        FileError: the file cannot be written, or Matplotlib does not know the format.
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
    """Return the file that a path refers to: for a symbolic link its target, which need not exist.

    Raises:
        FileError: the links form a cycle.
    """
    file = Path(os.path.realpath(path))
    if file.is_symlink():
        raise FileError(path, "is a symbolic link that refers to itself")
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
            os.fsync(opened.fileno())  # some disks report only now that they are full
        if file.exists():
            shutil.copymode(file, temporary)
        temporary.replace(file)
    finally:
        temporary.unlink(missing_ok=True)
