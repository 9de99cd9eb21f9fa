"""How the loops of the estimation are compiled, with a cache that follows the sources that they may come from."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba

from continuum import compiled_code
from continuum.dynamics import integration

__all__ = ["compiled", "entry_point"]

compiled: Callable[[Callable[..., Any]], Callable[..., Any]] = numba.njit
"""Compiles a function that is called from compiled code alone."""

entry_point = compiled_code.entry_point(Path(__file__).parent, Path(integration.__path__[0]), error_model="python")
"""Decorates the function that Python calls."""
