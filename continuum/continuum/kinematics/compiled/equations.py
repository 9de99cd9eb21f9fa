"""The library's equations, made known to numba, and how the solver's loops around them are compiled."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numba
import numpy as np
from numba.extending import register_jitable

from continuum import compiled_code, kinematics
from continuum.compiled_code import compiled
from continuum.kinematics import rigid, smooth_functions
from continuum.kinematics.chain import eq10_pose, eq11_jacobian
from continuum.kinematics.section import chord, eq04_pose, eq05_configuration_from_point, eq21_jacobian

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
    chord.chord_length,
    chord.chord_derivative,
    eq04_pose.rotation_entries,
    eq04_pose.position_entries,
    eq05_configuration_from_point.configuration_entries,
    eq21_jacobian.position_jacobian,
    eq21_jacobian.rotation_jacobian,
    eq10_pose.next_tip,
    eq11_jacobian.section_columns,
    eq11_jacobian._carried,
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
