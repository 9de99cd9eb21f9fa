"""Functions compiled by numba and kept on disk, by a key that follows all of their sources.

Numba's cache follows the file of the compiled function alone, and loads machine code unchecked: a damaged file ends the
program. So what numba keeps of an entry point is packed into one file with a digest of its content and of all sources.
Numba works in a temporary folder of this program, which is filled from that file if the digest fits, and packed again
after something was compiled. Programs that start at the same time never see a file that is half written.
"""

from __future__ import annotations

import contextlib
import fcntl
import functools
import hashlib
import inspect
import os
import shutil
import tempfile
import threading
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO, Literal

import numba

from continuum.compile_cache import CompiledFunction, announce_compilation, config, warn_not_kept

compiled = numba.njit(error_model="numpy")
"""Compiles a function that is called from compiled code alone; not cached by itself."""

ErrorModel = Literal["numpy", "python"]

_FOLDER = "continuum-compiled-"
_LOCK = "held"
_cache_dir_is_set = threading.Lock()


@functools.cache
def sources_digest(*places: Path) -> str:
    """Digest of Python files, and of all of them below folders."""
    digest = hashlib.sha256()
    for place in places:
        for path in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
            digest.update(path.read_bytes())
    return digest.hexdigest()


def entry_point(*sources: Path, error_model: ErrorModel = "numpy") -> Callable[[Callable[..., Any]], Any]:
    """Decorate a function that Python calls: compiled when it is first called, and kept on disk.

    Args:
        sources: files, and folders of files, that the compiled code may come from.
        error_model: numba's; with ``python``, division by zero is an error.
    """

    def decorate(function: Callable[..., Any]) -> Any:
        return function if config.DISABLE_JIT else EntryPoint(function, sources, error_model)

    return decorate


class EntryPoint:
    """A compiled function; call it as the one that it was made of, by position."""

    def __init__(self, function: Callable[..., Any], sources: tuple[Path, ...], error_model: ErrorModel) -> None:
        functools.update_wrapper(self, function)
        self._function, self._sources, self._error_model = function, sources, error_model
        self._dispatcher: Any = None
        self._folder: Path | None = None
        self._lock = threading.RLock()
        self._n_known, self._n_compiled = 0, 0

    def __call__(self, *arguments: Any) -> Any:
        dispatcher = self._dispatcher or self._started()
        try:
            result = dispatcher(*arguments)
        except OSError as error:  # of numba, before the call: it cannot keep what it compiled
            if self._folder is None:
                raise
            self._start_in_memory(error)
            return self(*arguments)
        if len(dispatcher.overloads) != self._n_known:
            self._keep()
        return result

    @property
    def signatures(self) -> list[Any]:
        """Types of arguments that it is compiled for in this program."""
        return list(self._dispatcher.signatures) if self._dispatcher else []

    @property
    def n_compiled(self) -> int:
        """For how many types of arguments this program had to compile it, which found nothing on disk."""
        return sum(self._dispatcher.stats.cache_misses.values()) if self._dispatcher else 0

    @functools.cached_property
    def _kept(self) -> CompiledFunction:
        source = Path(inspect.getfile(self._function))
        return CompiledFunction(
            source, self._function.__qualname__, f"{sources_digest(*self._sources)} {self._error_model}"
        )

    def _started(self) -> Any:
        """The function as numba calls it, with a folder that holds what was kept."""
        with self._lock:
            if self._dispatcher is None:
                try:
                    self._folder, held = _temporary_folder()
                    weakref.finalize(self, _let_go, self._folder, held)
                    if not self._kept.unpack(self._folder):
                        announce_compilation()
                    self._dispatcher = _with_cache(self._function, self._error_model, self._folder)
                except (OSError, RuntimeError) as error:  # RuntimeError: numba finds no place for its cache
                    self._start_in_memory(error)
            return self._dispatcher

    def _start_in_memory(self, error: Exception) -> None:
        warn_not_kept(error)
        self._folder = None
        self._dispatcher = numba.njit(error_model=self._error_model)(self._function)

    def _keep(self) -> None:
        """Pack what numba keeps if there is more of it than before."""
        with self._lock:
            self._n_known = len(self._dispatcher.overloads)
            if self._folder is not None and self._n_compiled != self.n_compiled:
                self._n_compiled = self.n_compiled
                try:
                    self._kept.pack(self._folder)
                except OSError as error:
                    warn_not_kept(error)


def _temporary_folder() -> tuple[Path, BinaryIO]:
    """A folder, and the lock by which this program holds it; those of programs that were killed are removed.

    A lock is seen where the number of a process is not: from another container that shares the folder for temporary
    files. It is there by its name only once it is held.
    """
    for lock in Path(tempfile.gettempdir()).glob(f"{_FOLDER}*/{_LOCK}"):
        _remove_unless_held(lock)
    folder = Path(tempfile.mkdtemp(prefix=_FOLDER))
    unnamed = folder / f"{_LOCK}.new"
    held = unnamed.open("wb")
    fcntl.flock(held, fcntl.LOCK_EX)
    unnamed.rename(folder / _LOCK)
    return folder, held


def _remove_unless_held(lock: Path) -> None:
    with contextlib.suppress(OSError), open(lock, "rb", opener=_without_waiting) as left:  # or it is somebody else's
        fcntl.flock(left, fcntl.LOCK_SH | fcntl.LOCK_NB)
        shutil.rmtree(lock.parent, ignore_errors=True)


def _without_waiting(path: str, flags: int) -> int:
    """Open a file, also a pipe that nobody writes to."""
    return os.open(path, flags | os.O_NONBLOCK)


def _let_go(folder: Path, held: BinaryIO) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    held.close()


def _with_cache(function: Callable[..., Any], error_model: ErrorModel, folder: Path) -> Any:
    """The function as numba compiles it, which chooses the folder of its cache now and keeps to it."""
    with _cache_dir_is_set:
        before = config.CACHE_DIR
        config.CACHE_DIR = str(folder)
        try:
            return numba.njit(cache=True, error_model=error_model)(function)
        finally:
            config.CACHE_DIR = before
