"""How often something happened, and how well that is known."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from scipy.stats import binomtest


@dataclass(frozen=True)
class Rate:
    """``k`` times of ``n``."""

    k: int
    n: int

    @classmethod
    def of(cls, happened: Iterable[bool]) -> Rate:
        each = list(happened)
        return cls(sum(each), len(each))

    @property
    def value(self) -> float:
        """0 to 1; NaN of none."""
        return self.k / self.n if self.n else float("nan")

    @property
    def interval(self) -> tuple[float, float]:
        """Of 95 % (Wilson 1927); 0 to 1 where nothing is known."""
        if not self.n:
            return 0.0, 1.0
        ends = binomtest(self.k, self.n).proportion_ci(0.95, method="wilson")
        return float(ends.low), float(ends.high)

    def __str__(self) -> str:
        if not self.n:
            return "-"
        low, high = (f"{100 * end:.0f}" for end in self.interval)
        return f"{100 * self.value:.0f} % ({low} to {high}, n {self.n})"
