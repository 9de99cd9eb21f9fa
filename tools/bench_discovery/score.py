"""From results to figures: what was answered, by effect, size, dataset and noise."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean

from blind.plant import EFFECTS, SIZES

from tools.bench_discovery.answer import Answer, answer, label
from tools.bench_discovery.rate import Rate
from tools.bench_discovery.result import Result

_FEWEST_A_SIZE = 5
_WANTED = 0.9


@dataclass(frozen=True)
class Tally:
    """Answers to some cases."""

    counts: Mapping[Answer, int]

    @property
    def n(self) -> int:
        """How many cases."""
        return sum(self.counts.values())

    def rate(self, *answers: Answer) -> Rate:
        """How often one of some answers was given."""
        return Rate(sum(self.counts.get(one, 0) for one in answers), self.n)

    @property
    def right(self) -> Rate:
        """The very effect, alone, at its joint."""
        return self.rate(Answer.RIGHT)

    @property
    def right_or_set(self) -> Rate:
        """That, or an ambiguous verdict that names it among others."""
        return self.rate(Answer.RIGHT, Answer.SET)

    @property
    def wrong(self) -> Rate:
        """A cause is named that is not there, or not at that joint."""
        return self.rate(Answer.WRONG_CAUSE, Answer.WRONG_JOINT)


def judged(result: Result) -> Answer:
    """What its verdict is worth."""
    return answer(result.hidden, result.verdict)


def tally(results: Iterable[Result]) -> Tally:
    """Count answers."""
    return Tally(Counter(judged(result) for result in results))


def tallies(results: Iterable[Result], by: Callable[[Result], str]) -> dict[str, Tally]:
    """Tallies of groups of results, those with most wrong causes first, then those least often right."""
    groups: dict[str, list[Result]] = {}
    for result in results:
        groups.setdefault(by(result), []).append(result)
    found = {name: tally(group) for name, group in groups.items()}
    return dict(sorted(found.items(), key=lambda item: (-item[1].wrong.value, item[1].right.value, item[0])))


def of_kind(results: Iterable[Result], kind: str) -> list[Result]:
    """Those of `clean`, `one`, `pairs` or `outside`."""
    return [result for result in results if result.kind == kind]


def name_of(result: Result) -> str:
    """What is hidden."""
    return " and ".join(result.plan.effects) or "nothing"


def confusion(results: Iterable[Result]) -> dict[str, Counter[str]]:
    """How often what was answered to each hidden effect; pairs are left out."""
    found: dict[str, Counter[str]] = {}
    for result in results:
        if result.kind != "pairs":
            found.setdefault(name_of(result), Counter())[label(result.verdict)] += 1
    order = [*EFFECTS, "nothing"]
    return dict(sorted(found.items(), key=lambda item: order.index(item[0])))


def ambiguous_sets(results: Iterable[Result]) -> dict[str, Counter[str]]:
    """Sets that were named where one effect is hidden and the data could not tell."""
    found: dict[str, Counter[str]] = {}
    for result in of_kind(results, "one"):
        if result.verdict is not None and result.verdict["verdict"] == "ambiguous":
            named = (cause["effect"] for cause in (*result.verdict["causes"], *result.verdict["alternatives"]))
            found.setdefault(name_of(result), Counter())[", ".join(sorted(set(named)))] += 1
    return found


def by_size(results: Iterable[Result], effect: str) -> dict[str, Tally]:
    """Tallies of one effect hidden alone, by size from the smallest."""
    mine = [result for result in of_kind(results, "one") if result.plan.effects == (effect,)]
    return {size: tally(result for result in mine if result.plan.size == size) for size in SIZES}


def smallest_found(tallies_by_size: Mapping[str, Tally], effect: str) -> str:
    """Amount that is named rightly with 90 % probability, between sizes along the logarithm; "-" of too few cases."""
    rates = [tallies_by_size[size].right for size in SIZES]
    if min(rate.n for rate in rates) < _FEWEST_A_SIZE:
        return "-"
    kind = EFFECTS[effect]
    reached = [rate.value >= _WANTED for rate in rates]
    if not reached[-1]:
        return f"more than {kind.sizes[-1]:g} {kind.unit}"
    first = max((i + 1 for i, good in enumerate(reached) if not good), default=0)
    if first == 0:
        return f"{kind.sizes[0]:g} {kind.unit} or less"
    low, high = rates[first - 1].value, rates[first].value
    part = (_WANTED - low) / (high - low)
    amount = math.exp((1 - part) * math.log(kind.sizes[first - 1]) + part * math.log(kind.sizes[first]))
    return f"{amount:.2g} {kind.unit}"


def gaps_closed(results: Iterable[Result]) -> list[float]:
    """Part of the distance to the noise floor that is closed on held-out runs, of each case with a verdict."""
    return [float(result.verdict["gap_closed"]) for result in results if result.verdict is not None]


def losses(results: Iterable[Result]) -> list[float]:
    """By what part Eq. 19 of the position grows on held-out runs, mean over the runs of each case with a verdict."""
    return [_loss(result.verdict["nrmse_position"].values()) for result in results if result.verdict is not None]


def _loss(runs: Iterable[Mapping[str, float | None]]) -> float:
    return fmean(
        math.inf if run["before"] is None or run["after"] is None else run["after"] / run["before"] - 1 for run in runs
    )


def worst(groups: Mapping[str, Tally], rate: Callable[[Tally], Rate]) -> tuple[str, Rate]:
    """Name and rate of the group whose rate is least."""
    name = min(groups, key=lambda one: rate(groups[one]).value)
    return name, rate(groups[name])


def quantile(values: Sequence[float], part: float) -> float:
    """The smallest value that at least a part of the values do not exceed; NaN of none."""
    ordered = sorted(values)
    return ordered[max(0, math.ceil(part * len(ordered)) - 1)] if ordered else float("nan")
