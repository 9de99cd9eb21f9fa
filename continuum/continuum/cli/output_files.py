"""Files that a command is asked to write, looked at before it begins its work."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from continuum.errors import FileError


def check_writable(path: str | None) -> None:
    """Open the file for writing, and leave everything as it was; nothing where there is no ``path``.

    Raises:
        FileError: it cannot be written.
    """
    if path is None:
        return
    file = Path(path)
    there = file.exists()
    if there and not file.is_file() and not file.is_dir():
        return  # a pipe or a terminal: whoever reads would see it closed
    try:
        with file.open("ab"):
            pass
        if not there:
            file.unlink()
    except OSError as error:
        raise FileError(path, f"cannot be written ({error.strerror or error})") from error


def check_apart(outputs: Sequence[str | None], inputs: Sequence[str | None]) -> None:
    """Every file that is written is another one, and none that is read, nor within a folder that is.

    Raises:
        FileError: one is not.
    """
    read = [Path(path).resolve() for path in inputs if path is not None]
    written: list[Path] = []
    for path in outputs:
        if path is None or (Path(path).exists() and not Path(path).is_file()):  # pipes, and what is refused anyhow
            continue
        file = Path(path).resolve()
        if any(one == file or one in file.parents for one in read):
            raise FileError(path, "is read, and would be overwritten: write to another file")
        if file in written:
            raise FileError(path, "would be written twice: name another file for each output")
        written.append(file)


def check_picture(path: str | None) -> None:
    """As :func:`check_writable`; its suffix must be that of a picture too.

    Raises:
        FileError: it cannot be written, or the format is not known.
    """
    if path is None:
        return
    check_writable(path)
    from matplotlib.figure import Figure  # here: it takes its time to load

    known = Figure().canvas.get_supported_filetypes()
    suffix = Path(path).suffix.removeprefix(".")
    if suffix and suffix.lower() not in known:
        raise FileError(path, f"cannot be drawn (format {suffix!r}; known: {', '.join(sorted(known))})")
