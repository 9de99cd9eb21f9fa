"""What is wanted of the diagnosis, and whether a campaign reached it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean

from tools.bench_discovery.answer import Answer
from tools.bench_discovery.calibration import expected_error, statements
from tools.bench_discovery.estimates import coverage, estimates, median_error
from tools.bench_discovery.plans import EIGHT
from tools.bench_discovery.rate import Rate
from tools.bench_discovery.result import Result
from tools.bench_discovery.score import (
    Tally,
    gaps_closed,
    losses,
    name_of,
    of_kind,
    quantile,
    tallies,
    tally,
    worst,
)

_ENOUGH = 20  # cases, of fewer of which nothing is said unless it is clear
_ENOUGH_OF_ONE = 5  # of a single effect
_NONE_IS_LESS = 3.0  # expected cases, of which none must happen by chance in one of twenty campaigns
WANTED_OF_EACH = 0.85
"""Rate of right that every effect shall have at least."""
MET, MISSED, TOO_FEW = "met", "**missed**", "too few"


@dataclass(frozen=True)
class Goal:
    """One line: what, what is wanted, what came out, and whether that is enough."""

    what: str
    wanted: str
    figure: str
    status: str


def goals(results: Sequence[Result]) -> list[Goal]:
    """All of them, the worst kind of failure first."""
    one, clean, outside = (of_kind(results, kind) for kind in ("one", "clean", "outside"))
    alone, nothing, strange = tally(one), tally(clean), tally(outside)
    pairs = tally(of_kind(results, "pairs"))
    lines = [
        Goal("a wrong cause or joint is named, whatever is hidden", "none wanted", str(tally(results).wrong), ""),
        at_least("one effect: named alone, at its joint", 0.95, alone.right),
        at_least("the same, or in an ambiguous set that holds it", 0.95, alone.right_or_set),
        *_worst_effect(one),
        at_most("nothing hidden: a false alarm", 0.01, Rate(nothing.n - nothing.right.k, nothing.n)),
        at_least("outside of the library: unknown", 0.90, strange.right),
        at_most("in the library: unknown", 0.05, alone.rate(Answer.UNKNOWN)),
        at_least("two effects: exactly these", 0.80, pairs.right),
    ]
    return [*lines, *_of_figures(results, one, clean), _time(results)]


def at_least(what: str, goal: float, rate: Rate, enough: int = _ENOUGH) -> Goal:
    """A rate that shall be high."""
    status = _status(rate, rate.value >= goal, rate.interval[1] < goal, enough)
    return Goal(what, f">= {100 * goal:g} %", str(rate), status)


def at_most(what: str, goal: float, rate: Rate) -> Goal:
    """A rate that shall be low."""
    status = _status(rate, rate.value <= goal, rate.interval[0] > goal, max(_ENOUGH, round(_NONE_IS_LESS / goal)))
    return Goal(what, f"<= {100 * goal:g} %", str(rate), status)


def _status(rate: Rate, reached: bool, clearly_missed: bool, enough: int) -> str:
    if clearly_missed:
        return MISSED
    return _of_count(rate.n, reached, enough)


def _of_count(n: int, reached: bool, enough: int = _ENOUGH) -> str:
    if n < enough:
        return TOO_FEW
    return MET if reached else MISSED


def _worst_effect(one: Sequence[Result]) -> list[Goal]:
    groups = tallies(one, name_of)
    if not groups:
        return []
    lines = []
    for what, rate_of in (("named", lambda t: t.right), ("named or in a set", lambda t: t.right_or_set)):
        name, rate = worst(groups, rate_of)
        lines.append(at_least(f"the effect least often {what}: `{name}`", WANTED_OF_EACH, rate, _ENOUGH_OF_ONE))
    return lines


def _of_figures(results: Sequence[Result], one: Sequence[Result], clean: Sequence[Result]) -> list[Goal]:
    stated, found = statements(results), estimates(one)
    ece, error, covered = expected_error(stated), median_error(found), coverage(found)
    closed, lost = gaps_closed(one), losses(clean)
    mean_closed = fmean(closed) if closed else float("nan")
    mean_lost = fmean(lost) if lost else float("nan")
    in_band = 0.90 <= covered.value <= 0.98
    off_band = covered.interval[1] < 0.90 or covered.interval[0] > 0.98
    return [
        Goal(
            "stated confidence: ECE", "<= 0.05",
            _number(ece, len(stated), "{:.3f}"), _of_count(len(stated), ece <= 0.05),
        ),
        Goal("95 % intervals hold the truth", "90 to 98 %", str(covered), _status(covered, in_band, off_band, _ENOUGH)),
        Goal("parameters: median error", "<= 10 %", _percent(error, len(found)), _of_count(len(found), error <= 0.1)),
        Goal(
            "one effect: distance to the noise floor closed on held-out runs, mean", ">= 80 %",
            _percent(mean_closed, len(closed)), _of_count(len(closed), mean_closed >= 0.8),
        ),
        Goal(
            "nothing hidden: Eq. 19 of the position lost on held-out runs, mean", "<= 2 %",
            _percent(mean_lost, len(lost)), _of_count(len(lost), mean_lost <= 0.02),
        ),
    ]  # fmt: skip


def _time(results: Sequence[Result]) -> Goal:
    seconds = [result.seconds for result in results if result.plan.dataset == EIGHT]
    slowest = quantile(seconds, 1.0)
    return Goal(
        "eight releases of 1.6 s: processor time, the slowest",
        "<= 240 s, 120 s on two cores",
        _number(slowest, len(seconds), "{:.0f} s"),
        _of_count(len(seconds), slowest <= 240.0, _ENOUGH_OF_ONE),
    )


def _number(value: float, n: int, form: str) -> str:
    return f"{form.format(value)} (n {n})" if n else "-"


def _percent(part: float, n: int) -> str:
    return _number(100 * part, n, "{:.1f} %")


def counts(groups: Tally) -> list[int]:
    """Cases by answer, from the worst."""
    return [groups.counts.get(one, 0) for one in Answer]
