"""Cable commands that an arm can follow: lengths of a posture that it has, within its limits."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.kinematics.configuration import bend
from continuum.parameter_spec import ParameterSpec

TOLERANCE = ParameterSpec(
    "tolerance", float, "how far commanded lengths may be from those of the nearest posture", "m", 0.0, 1.0,
    lower_open=True, default=1e-3,
)  # fmt: skip
"""Parameter of the nodes that take lengths as commands."""

LIMIT_SLACK = 1e-6
"""Bend beyond the limit that is rounding [rad]."""


def check_lengths(lengths: Array, names: Sequence[str]) -> None:
    """The lengths (n_cables,) [m] are positive.

    Raises:
        InvalidValueError: one is not.
    """
    for name, length in zip(names, lengths.tolist(), strict=True):
        if not length > 0.0:
            raise InvalidValueError(f"length of {name}", length, "more than 0 m")


def check_configuration(w: Array, sections: Sequence[Section]) -> None:
    """The configurations ``w`` (n_sections, 2), or (2,) of one section, [rad] are within the sections' limits.

    Raises:
        InvalidValueError: one is bent beyond its limit, or is none.
    """
    for section, theta in zip(sections, np.atleast_1d(bend(w)).tolist(), strict=True):
        if not theta <= section.bend_limit + LIMIT_SLACK:
            raise InvalidValueError(
                f"bend of {section.name}", theta, f"up to its bend_limit {section.bend_limit:g} rad"
            )


def check_fit(lengths: Array, of_posture: Array, names: Sequence[str], tolerance: float) -> None:
    """The commanded lengths (n_cables,) [m] are those of the posture found for them, within the ``tolerance`` [m].

    Raises:
        InvalidValueError: one differs; no posture has all of these lengths.
    """
    off = np.abs(lengths - of_posture)
    if not (off <= tolerance).all():
        i = int(np.argmax(np.where(np.isfinite(off), off, np.inf)))
        allowed = f"{float(of_posture[i]):.6g} within the tolerance, {tolerance:g} m, as in the nearest posture"
        raise InvalidValueError(f"length of {names[i]}", float(lengths[i]), allowed)


def check_rates(w_rate: Array) -> None:
    """The rates of the configurations [rad/s] are finite.

    Raises:
        InvalidValueError: they are not.
    """
    if not np.isfinite(w_rate).all():
        raise InvalidValueError("rate of the configuration", w_rate.tolist(), "finite, from the commanded velocities")
