"""Compilation by numba, kept on disk under a key that follows every source of this plant.

numba looks at the compiled function's own file alone, and equations here come from several; so whatever is kept is
built around a digest of them all.
"""

import hashlib
from functools import cache
from pathlib import Path

import numba

compiled = numba.njit(error_model="numpy")
kept = numba.njit(error_model="numpy", cache=True)


@cache
def digest_of_sources() -> str:
    """Of all Python files of this plant."""
    total = hashlib.sha256()
    for path in sorted(Path(__file__).parent.rglob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()
