"""Functions compiled by numba and kept on disk, by a key that follows all of their sources.

Numba's cache looks at the file of the compiled function alone; loops here call equations from many files. So every
entry point carries a digest of all of them in its closure, which is a part of the cache's key.

What was compiled is kept beside the sources. Where that folder is read-only it is read from there, or else kept in
``$XDG_CACHE_HOME/continuum/compiled`` (``~/.cache/...`` without it); where nothing can be written, it is kept nowhere.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from numba.core import caching as numba_caching

caching: Any = numba_caching  # numba has types in some places alone

compiled = numba.njit(error_model="numpy")
"""Compiles a function that is called from compiled code alone; not cached by itself."""


def sources_digest(*folders: Path) -> str:
    """Digest of all Python files below the ``folders``."""
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted(folder.rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def entry_point(build: Callable[[str], Callable[..., Any]], digest: str) -> Callable[..., Any]:
    """Compile, once and cached on disk, the function that ``build`` makes around the ``digest`` of its sources."""
    function: Callable[..., Any] = compiled(build(digest))
    if hasattr(function, "py_func"):  # not where numba is switched off
        with contextlib.suppress(RuntimeError):  # no folder can be written: compiled anew in every program
            dispatcher: Any = function
            dispatcher._cache = _Cache(dispatcher.py_func)
    return function


class _Installed(caching.InTreeCacheLocator):  # type: ignore[misc]
    """Reads what was compiled by whoever installed the package, in a folder that cannot be written."""

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> Any:
        """The locator, or None where nothing was compiled."""
        found = cls(py_func, py_file)
        there = Path(found.get_cache_path())
        return found if any(there.glob(f"{Path(py_file).stem}.*.nbi")) else None


class _OfUser(caching.InTreeCacheLocator):  # type: ignore[misc]
    """Keeps what was compiled in the user's cache folder."""

    def __init__(self, py_func: Any, py_file: str) -> None:
        super().__init__(py_func, py_file)
        base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
        self._cache_path = str(Path(base, "continuum", "compiled", self.get_suitable_cache_subpath(py_file)))


class _Folders(caching.CompileResultCacheImpl):  # type: ignore[misc]
    _locator_classes = [caching.UserProvidedCacheLocator, caching.InTreeCacheLocator, _Installed, _OfUser]  # noqa: RUF012


class _Cache(caching.FunctionCache):  # type: ignore[misc]
    _impl_class = _Folders

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what was compiled if the folder lets it."""
        try:
            super().save_overload(sig, data)
        except OSError:  # read-only, full: the program works all the same
            return
