"""The library's equations, made known to numba, and how the solver's loops around them are compiled."""

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
"""As `compiled`, for small functions called all the time: handing over an arm's arrays takes as long as their work."""

merged = numba.njit(error_model="numpy", inline="always")
"""As `compiled`, for functions with one caller: they become a part of it, which spares compiling them apart."""


def argument(value: Any) -> Any:
    """A constant to hand to compiled functions; numba would compile one more version for a plain number alone."""
    return np.asarray(value)[()]


entry_point = compiled_code.entry_point(Path(kinematics.__path__[0]))
"""Decorates the function that Python calls; its code may come from all files of the kinematics."""
