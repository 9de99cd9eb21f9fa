"""Checks of a command's output files before the command starts its work."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from continuum.errors import FileError
from continuum.whole_file import target_of


def check_writable(path: str | Path | None) -> None:
    """Check that a file can be opened for writing, without changing anything; do nothing if ``path`` is None.

    Missing folders are created for the check, and removed.

    Raises:
        FileError: the file cannot be written, or its folders cannot be created.
    """
    if path is None:
        return
    if str(path).endswith(os.sep):
        raise FileError(path, "is a folder: name a file in it")
    with folder_of(path):
        try:
            file = target_of(path)
            there = file.exists()
            if there and not file.is_file() and not file.is_dir():
                return  # a pipe or a terminal: its reader would see it closed
            with file.open("ab"):
                pass
            if not there:
                file.unlink()
        except OSError as error:
            raise FileError(path, f"cannot be written ({error.strerror or error})") from error


@contextmanager
def folder_of(path: str | Path) -> Iterator[None]:
    """Create the folders that a file needs; remove those that are still empty afterwards.

    Raises:
        FileError: a folder cannot be created.
    """
    folder = Path(path).parent
    missing: list[Path] = []
    try:
        try:
            missing += [one for one in (folder, *folder.parents) if not one.exists()]
            if missing:
                folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileError(path, f"cannot be written ({error.strerror or error})") from error
        yield
    finally:
        for one in missing:
            with suppress(OSError):  # the folder is not empty
                one.rmdir()


def check_apart(outputs: Sequence[str | Path | None], inputs: Sequence[str | Path | None]) -> None:
    """Check that the output files are distinct, and that none is an input file or in an input folder.

    Symbolic and hard links count as the files that they refer to.

    Raises:
        FileError: an output file is not distinct.
    """
    read = [target_of(path) for path in inputs if path is not None]
    written: list[Path] = []
    for path in outputs:
        if path is None:
            continue
        file = target_of(path)
        if file.exists() and not file.is_file():  # pipes, and paths that are refused elsewhere
            continue
        if any(one in (file, *file.parents) for one in read) or _is_among(file, _files_of(read)):
            raise FileError(path, "is read, and would be overwritten: write to another file")
        if file in written or _is_among(file, written):
            raise FileError(path, "would be written twice: name another file for each output")
        written.append(file)


def check_page(path: str | Path | None) -> None:
    """As :func:`check_writable`, and check that the name ends in .html.

    Raises:
        FileError: the file cannot be written, or its name does not end in .html.
    """
    if path is not None and Path(path).suffix.lower() != ".html":
        raise FileError(path, "does not end in .html: a report is a page for a browser")
    check_writable(path)


def check_picture(path: str | Path | None) -> None:
    """As :func:`check_writable`, and check that the suffix is that of a picture format.

    Raises:
        FileError: the file cannot be written, or the format is unknown.
    """
    if path is None:
        return
    check_writable(path)
    from matplotlib.figure import Figure  # imported here because it is slow to load

    known = Figure().canvas.get_supported_filetypes()
    suffix = Path(path).suffix.removeprefix(".")
    if suffix and suffix.lower() not in known:
        raise FileError(path, f"cannot be drawn (format {suffix!r}; known: {', '.join(sorted(known))})")


def _files_of(read: Sequence[Path]) -> Iterator[Path]:
    """Yield files, and all files in folders."""
    for one in read:
        yield from one.rglob("*") if one.is_dir() else [one]


def _is_among(file: Path, others: Iterator[Path] | Sequence[Path]) -> bool:
    """Return whether an existing file is one of the others, possibly under another name."""
    return file.exists() and any(other.exists() and file.samefile(other) for other in others)
