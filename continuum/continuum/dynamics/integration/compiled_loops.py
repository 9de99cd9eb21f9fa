"""How the integrator's loops are compiled, with a cache that follows the sources of this folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from continuum import compiled_code
from continuum.compiled_code import compiled, sources_digest

__all__ = ["compiled", "entry_point"]


def entry_point(build: Callable[[str], Callable[..., Any]]) -> Callable[..., Any]:
    """Compile, cached on disk, the function that ``build`` makes around the digest of this folder's sources."""
    return compiled_code.entry_point(build, sources_digest(Path(__file__).parent))
