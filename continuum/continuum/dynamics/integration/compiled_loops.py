"""How the integrator's loops are compiled, and a cache that follows all of their sources.

Numba's own cache looks at the file of the compiled function alone; the integrator spans several, so its entry point
carries a digest of all of them in its closure, which is a part of the cache's key.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba

compiled = numba.njit(error_model="numpy")
"""Compiles a function that is called from compiled code alone; not cached by itself."""


def entry_point(build: Callable[[str], Callable[..., Any]]) -> Callable[..., Any]:
    """Compile, cached on disk, the function that ``build`` makes around the digest of this folder's sources."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    function: Callable[..., Any] = numba.njit(build(digest.hexdigest()), cache=True, error_model="numpy")
    return function
