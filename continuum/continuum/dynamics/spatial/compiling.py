"""How the loops of the chain are compiled: sums may be reordered, but NaN and infinity stay what they are."""

from __future__ import annotations

from pathlib import Path

import numba

from continuum import compiled_code

FAST = {"reassoc", "contract", "nsz", "arcp"}
"""LLVM's flags: without ``nnan`` and ``ninf``, so that a state that is not finite is seen."""

inner = numba.njit(error_model="numpy", fastmath=FAST)
"""Decorator of a function that only compiled code calls; it has no cache of its own."""

merged = numba.njit(error_model="numpy", fastmath=FAST, inline="always")
"""As `inner`, for functions with one caller: passing the arrays of an arm would take as long as their work.

They become a part of the caller, and have its flags: none in an entry point.
"""

entry_point = compiled_code.entry_point(Path(__file__).parent)
"""Decorator of a function that Python calls: compiled at its first call, and kept on disk until a file here changes."""
