"""One value with its 95 % interval."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

Z_95: Final = 1.96
"""Half of a 95 % interval, in standard deviations of a normal distribution."""


@dataclass(frozen=True)
class Estimate:
    """One value with its 95 % interval.

    Attributes:
        name: parameter of Eq. 12, or effect and parameter with a dot between.
        joint: joint from 0; None if it belongs to none, or to all alike.
        recording: recording of a per-run value; empty if all recordings share the value.
        value, low, high: value and interval in its unit; the ends are NaN if no interval is known.
        unit: SI unit.
        meaning: one sentence.
        start: value in the model file; NaN if it has none.
        lower, upper: bounds of the fit.
    """

    name: str
    joint: int | None
    recording: str
    value: float
    low: float
    high: float
    unit: str
    meaning: str
    start: float = math.nan
    lower: float = -math.inf
    upper: float = math.inf

    @property
    def is_at_bound(self) -> bool:
        """Whether it is at a bound, so that it may be wrong."""
        near = 1e-6 * max(abs(self.value), 1e-12)
        return abs(self.value - self.lower) <= near or abs(self.value - self.upper) <= near

    def __str__(self) -> str:
        where = "" if self.joint is None else f"[{self.joint + 1}]"
        return f"{self.name}{where}" + f" in {self.recording}" * bool(self.recording)
