"""Registration of the library's equations with numba, and the decorators that compile the solver's loops."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numba
import numpy as np
from numba.extending import register_jitable

from continuum import compiled_code, kinematics
from continuum.compiled_code import compiled
from continuum.kinematics import chain, rigid, section, smooth_functions

_EQUATIONS = (
    smooth_functions.sinc,
    smooth_functions.versine,
    smooth_functions.sinc_derivative,
    smooth_functions.one_minus_sinc,
    rigid.rotated,
    rigid.turned_about_z,
    rigid.product,
    rigid.transposed,
    rigid.cross,
    section.chord_length,
    section.chord_derivative,
    section.rotation_entries,
    section.position_entries,
    section.configuration_entries,
    section.position_jacobian,
    section.rotation_jacobian,
    chain.next_tip,
    chain.section_columns,
    chain._carried,
)
for _equation in _EQUATIONS:
    register_jitable(_equation)

__all__ = ["argument", "compiled", "entry_point", "inlined", "merged"]

inlined = numba.njit(error_model="numpy", forceinline=True)
"""As `compiled`, for small functions with many calls: passing an arm's arrays would take as long as their work."""

merged = numba.njit(error_model="numpy", inline="always")
"""As `compiled`, for functions with one caller: they are inlined there and not compiled separately."""


def argument(value: Any) -> Any:
    """Return a constant for calls of compiled functions; numba would compile another version for a plain number."""
    return np.asarray(value)[()]


entry_point = compiled_code.entry_point(Path(kinematics.__path__[0]))
"""Decorator of functions that Python calls; their code may come from all files of the kinematics."""
