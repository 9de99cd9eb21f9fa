"""Whether causes are there as often as the confidence that is stated of them says."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import fmean

from tools.bench_discovery.answer import is_it
from tools.bench_discovery.rate import Rate
from tools.bench_discovery.result import Result

_BINS = 10


@dataclass(frozen=True)
class Stated:
    """One confidence, 0 to 1, and whether what it was stated of is hidden."""

    confidence: float
    is_there: bool


@dataclass(frozen=True)
class Bin:
    """Statements of like confidence."""

    stated: Sequence[Stated]

    @property
    def confidence(self) -> float:
        """Their mean."""
        return fmean(one.confidence for one in self.stated)

    @property
    def rate(self) -> Rate:
        """How often they hold."""
        return Rate.of(one.is_there for one in self.stated)


def statements(results: Iterable[Result], kinds: Sequence[str] = ("cause", "ambiguous")) -> list[Stated]:
    """All that is stated in verdicts of some kinds, whatever is hidden; what only helps where it is unknown is not."""
    return [
        Stated(float(named["confidence"]), any(is_it(effect, named) for effect in result.hidden))
        for result in results
        if result.verdict is not None and result.verdict["verdict"] in kinds
        for named in (*result.verdict["causes"], *result.verdict["alternatives"])
    ]


def bins(stated: Iterable[Stated]) -> list[Bin]:
    """Ten equally wide ones, from the lowest confidence; empty ones are left out."""
    groups: list[list[Stated]] = [[] for _ in range(_BINS)]
    for one in stated:
        groups[min(int(_BINS * one.confidence), _BINS - 1)].append(one)
    return [Bin(group) for group in groups if group]


def expected_error(stated: Sequence[Stated]) -> float:
    """ECE: mean distance of confidence and rate over the bins, weighed by their sizes (Naeini 2015); NaN of none."""
    if not stated:
        return float("nan")
    return sum(len(one.stated) * abs(one.confidence - one.rate.value) for one in bins(stated)) / len(stated)
