"""Functions compiled by numba and cached on disk, with a key that depends on all of their sources.

Numba's cache depends only on the file of the compiled function, and loads machine code unchecked: a damaged file
crashes the program. Here, the cache of an entry point is packed into one file with a digest of its content and of all
sources. Numba works in a temporary folder of the program, which is filled from that file if the digest matches, and
packed again after a compilation. Programs that start at the same time never read a partly written file.
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
"""Decorator of a function that only compiled code calls; it has no separate cache."""

ErrorModel = Literal["numpy", "python"]

_FOLDER = "continuum-compiled-"
_LOCK = "held"
_cache_dir_is_set = threading.Lock()


@functools.cache
def sources_digest(*places: Path) -> str:
    """Return a digest of Python files and of all Python files in folders."""
    digest = hashlib.sha256()
    for place in places:
        for path in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
            digest.update(path.read_bytes())
    return digest.hexdigest()


def entry_point(*sources: Path, error_model: ErrorModel = "numpy") -> Callable[[Callable[..., Any]], Any]:
    """Decorate a function that Python calls: it is compiled at its first call and cached on disk.

    Args:
        sources: files and folders with the sources of the compiled code.
        error_model: numba's; with ``python``, division by zero is an error.
    """

    def decorate(function: Callable[..., Any]) -> Any:
        return function if config.DISABLE_JIT else EntryPoint(function, sources, error_model)

    return decorate


class EntryPoint:
    """A compiled function; its arguments are those of the original function, by position."""

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
        except OSError as error:  # raised by numba before the call, if it cannot store the compiled code
            if self._folder is None:
                raise
            self._start_in_memory(error)
            return self(*arguments)
        if len(dispatcher.overloads) != self._n_known:
            self._keep()
        return result

    @property
    def signatures(self) -> list[Any]:
        """Argument types for which this program has compiled or loaded the function."""
        return list(self._dispatcher.signatures) if self._dispatcher else []

    @property
    def n_compiled(self) -> int:
        """Number of argument types for which this program had to compile it, because the cache had no code."""
        return sum(self._dispatcher.stats.cache_misses.values()) if self._dispatcher else 0

    @functools.cached_property
    def _kept(self) -> CompiledFunction:
        source = Path(inspect.getfile(self._function))
        return CompiledFunction(
            source, self._function.__qualname__, f"{sources_digest(*self._sources)} {self._error_model}"
        )

    def _started(self) -> Any:
        """Return numba's dispatcher of the function, with a folder filled from the cache."""
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
        """Pack numba's cache if it has grown."""
        with self._lock:
            self._n_known = len(self._dispatcher.overloads)
            if self._folder is not None and self._n_compiled != self.n_compiled:
                self._n_compiled = self.n_compiled
                try:
                    self._kept.pack(self._folder)
                except OSError as error:
                    warn_not_kept(error)


def _temporary_folder() -> tuple[Path, BinaryIO]:
    """Return a new folder and the lock by which this program holds it; remove folders of programs that were killed.

    Unlike a process id, a lock is also visible from other containers that share the folder for temporary files. A lock
    file gets its name only after it is locked.
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
    with contextlib.suppress(OSError), open(lock, "rb", opener=_without_waiting) as left:  # or it is another user's
        fcntl.flock(left, fcntl.LOCK_SH | fcntl.LOCK_NB)
        shutil.rmtree(lock.parent, ignore_errors=True)


def _without_waiting(path: str, flags: int) -> int:
    """Open a file without blocking, even a pipe without a writer."""
    return os.open(path, flags | os.O_NONBLOCK)


def _let_go(folder: Path, held: BinaryIO) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    held.close()


def _with_cache(function: Callable[..., Any], error_model: ErrorModel, folder: Path) -> Any:
    """Return the function compiled by numba, which chooses its cache folder at this moment."""
    with _cache_dir_is_set:
        before = config.CACHE_DIR
        config.CACHE_DIR = str(folder)
        try:
            return numba.njit(cache=True, error_model=error_model)(function)
        finally:
            config.CACHE_DIR = before
