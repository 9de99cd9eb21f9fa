"""Checks of cable commands: the lengths must belong to a posture within the limits of the arm."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.kinematics.configuration import bend
from continuum.parameter_spec import ParameterSpec

TOLERANCE = ParameterSpec(
    "tolerance", float, "largest difference of commanded lengths from those of the nearest posture", "m", 0.0, 1.0,
    lower_open=True, default=1e-3,
)  # fmt: skip
"""Parameter of the nodes that accept lengths as commands."""

LIMIT_SLACK = 1e-6
"""Bend beyond the limit that counts as rounding [rad]."""


def check_lengths(lengths: Array, names: Sequence[str]) -> None:
    """Check that the lengths (n_cables,) [m] are positive.

    Raises:
        InvalidValueError: a length is not positive.
    """
    for name, length in zip(names, lengths.tolist(), strict=True):
        if not length > 0.0:
            raise InvalidValueError(f"length of {name}", length, "more than 0 m")


def check_configuration(w: Array, sections: Sequence[Section]) -> None:
    """Check that configurations ``w`` (n_sections, 2), or (2,) of one section, [rad] are within the bend limits.

    Raises:
        InvalidValueError: a section is bent beyond its limit, or its bend is not a number.
    """
    for section, theta in zip(sections, np.atleast_1d(bend(w)).tolist(), strict=True):
        if not theta <= section.bend_limit + LIMIT_SLACK:
            raise InvalidValueError(
                f"bend of {section.name}", theta, f"up to its bend_limit {section.bend_limit:g} rad"
            )


def check_fit(lengths: Array, of_posture: Array, names: Sequence[str], tolerance: float) -> None:
    """Check that commanded lengths (n_cables,) [m] equal those of the nearest posture within the ``tolerance`` [m].

    Raises:
        InvalidValueError: a length differs; no posture has all of these lengths.
    """
    off = np.abs(lengths - of_posture)
    if not (off <= tolerance).all():
        i = int(np.argmax(np.where(np.isfinite(off), off, np.inf)))
        allowed = f"{float(of_posture[i]):.6g} within the tolerance, {tolerance:g} m, as in the nearest posture"
        raise InvalidValueError(f"length of {names[i]}", float(lengths[i]), allowed)


def check_rates(w_rate: Array) -> None:
    """Check that the rates of the configurations [rad/s] are finite.

    Raises:
        InvalidValueError: they are not finite.
    """
    if not np.isfinite(w_rate).all():
        raise InvalidValueError("rate of the configuration", w_rate.tolist(), "finite, from the commanded velocities")
