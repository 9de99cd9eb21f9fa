"""Cache of compiled code, so that later programs need not compile it again."""

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
"""An object of numba, which has no type annotations."""

_log = logging.getLogger("continuum")

_warned = threading.Event()
_announced = threading.Event()


def user_cache_folder() -> Path:
    """Return ``$XDG_CACHE_HOME/continuum``, or ``~/.cache/continuum`` without that variable; it need not exist.

    Raises:
        FileError: the user has no home folder.
    """
    try:
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "continuum")
    except RuntimeError as error:
        raise FileError("~/.cache", f"cannot be found ({error}); set XDG_CACHE_HOME") from error


def warn_not_kept(error: Exception) -> None:
    """Warn once per program that compiled code cannot be cached."""
    if not _warned.is_set():
        _warned.set()
        text = f"compiled code cannot be cached, so every program compiles it again ({error}); set XDG_CACHE_HOME"
        warnings.warn(text, RuntimeWarning, stacklevel=2)


def announce_compilation() -> None:
    """Log once per program that it compiles: the first call takes half a minute; later programs use the cache."""
    if not _announced.is_set():
        _announced.set()
        _log.info("compiling for this machine; this happens once and takes a minute or more")


@dataclass(frozen=True)
class CompiledFunction:
    """The file with numba's cache of one function.

    It is in the ``__pycache__`` folder beside the function's source, or in the user's cache folder if that is not
    writable. ``NUMBA_CACHE_DIR`` replaces both.

    Attributes:
        source: source file of the function.
        name: name of the function, unique within that file.
        key: key that changes when earlier compiled code becomes invalid.
    """

    source: Path
    name: str
    key: str

    def unpack(self, folder: Path) -> bool:
        """Unpack the cached files into the empty ``folder``; return False if there is no valid cache file.

        Raises:
            OSError: the folder cannot be written.
        """
        for file in reversed([*self._files()]):  # a file in the second place contains all of the first and more
            packed = read_checked(file, self._full_key())
            if packed is not None:
                with zipfile.ZipFile(io.BytesIO(packed)) as archive:
                    archive.extractall(folder)
                return True
        return False

    def pack(self, folder: Path) -> None:
        """Pack all files of ``folder`` into the cache file.

        Raises:
            OSError: no place is writable.
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
        """Yield the possible places of the file, the preferred one first."""
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
