"""Where compiled code is kept, so that the next program need not compile it."""

from __future__ import annotations

import contextlib
import hashlib
import io
import logging
import os
import sys
import threading
import warnings
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numba
import numpy as np

from continuum.checked_file import read_checked, write_checked
from continuum.errors import FileError

config: Any = numba.config
"""Numba's, which has no types."""

_log = logging.getLogger("continuum")

_warned = threading.Event()
_announced = threading.Event()


def user_cache_folder() -> Path:
    """``$XDG_CACHE_HOME/continuum``, without that variable ``~/.cache/continuum``; it need not exist.

    Raises:
        FileError: the user has no home folder.
    """
    try:
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "continuum")
    except RuntimeError as error:
        raise FileError("~/.cache", f"cannot be found ({error}); set XDG_CACHE_HOME") from error


def warn_not_kept(error: Exception) -> None:
    """Say, once in a program, that compiled code is not kept."""
    if not _warned.is_set():
        _warned.set()
        text = f"compiled code cannot be kept, every program compiles again ({error}); set XDG_CACHE_HOME"
        warnings.warn(text, RuntimeWarning, stacklevel=2)


def announce_compilation() -> None:
    """Log, once in a program, that it compiles: the first call takes half a minute, later programs none of it."""
    if not _announced.is_set():
        _announced.set()
        _log.info("compiling for this machine; this takes up to a minute, once")


@dataclass(frozen=True)
class CompiledFunction:
    """The file that holds numba's cache of one function.

    It lies next to the function's source, in ``__pycache__``, or where that cannot be written in the user's cache
    folder. ``NUMBA_CACHE_DIR`` names another folder in place of both.

    Attributes:
        source: file that the function is written in.
        name: of the function, unlike any other of that file.
        key: changes when compiled code of before may no longer be used.
    """

    source: Path
    name: str
    key: str

    def unpack(self, folder: Path) -> bool:
        """Fill the empty ``folder`` with what was packed; False if no valid file was found.

        Raises:
            OSError: the folder cannot be written.
        """
        for file in reversed([*self._files()]):  # what had to be kept elsewhere has all of the first and more
            packed = read_checked(file, self._full_key())
            if packed is not None:
                with zipfile.ZipFile(io.BytesIO(packed)) as archive:
                    archive.extractall(folder)
                return True
        return False

    def pack(self, folder: Path) -> None:
        """Keep everything that is in ``folder``.

        Raises:
            OSError: no place can be written.
        """
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w") as archive:
            for path in sorted(folder.rglob("*.nb[ic]")):
                archive.write(path, path.relative_to(folder))
        refused: OSError | None = None
        for file in self._files():
            try:
                write_checked(file, packed.getvalue(), self._full_key())
            except OSError as error:
                refused = refused or error
            else:
                return
        if refused is not None:
            raise refused

    def _files(self) -> Iterator[Path]:
        """Places for the file, the best first."""
        versions = f"{sys.implementation.cache_tag}-numba-{numba.__version__}-numpy-{np.__version__}"
        name = f"{self.source.stem}.{self.name}.{versions}.compiled"
        folder = f"{self.source.parent.name}-{hashlib.sha256(str(self.source.parent).encode()).hexdigest()[:16]}"
        if config.CACHE_DIR:
            yield Path(config.CACHE_DIR, folder, name)
            return
        yield self.source.parent / "__pycache__" / name
        with contextlib.suppress(FileError):
            yield user_cache_folder() / "compiled" / folder / name

    def _full_key(self) -> str:
        return f"{self.key} {sys.version} {numba.__version__} {np.__version__}"
