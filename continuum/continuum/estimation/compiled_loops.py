"""Decorators that compile the loops of the estimation, with a cache that depends on their possible sources."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba

from continuum import compiled_code
from continuum.dynamics import integration

__all__ = ["compiled", "entry_point"]

compiled: Callable[[Callable[..., Any]], Callable[..., Any]] = numba.njit
"""Compiles a function that is called only from compiled code."""

entry_point = compiled_code.entry_point(Path(__file__).parent, Path(integration.__path__[0]), error_model="python")
"""Compiles a function that is called from Python."""
