"""How the integrator's loops are compiled, with a cache that follows the sources of this folder."""

from __future__ import annotations

from pathlib import Path

from continuum import compiled_code
from continuum.compiled_code import compiled

__all__ = ["compiled", "entry_point"]

entry_point = compiled_code.entry_point(Path(__file__).parent)
"""Decorates the function that Python calls."""
