"""Tolerances of an integration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.errors import InvalidValueError


@dataclass(frozen=True)
class Tolerances:
    """Tolerances of an integration; the defaults are those of the thesis (chapter 3.2).

    Attributes:
        relative, absolute: allowed local error, the latter in the units of the state [rad, rad/s].
        max_step: longest step [s].
        most_steps: most steps between two outputs; a simulation that needs more fails.
    """

    relative: float = 1e-4
    absolute: float = 1e-5
    max_step: float = 0.01
    most_steps: int = 200_000

    def __post_init__(self) -> None:
        for name in ("relative", "absolute", "max_step", "most_steps"):
            if not 0 < getattr(self, name) < np.inf:
                raise InvalidValueError(name, getattr(self, name), "a finite number > 0")
