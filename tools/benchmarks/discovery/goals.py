"""Figures of the diagnosis with their goals."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Final

from tools.benchmarks.discovery import figures
from tools.benchmarks.discovery.answer import Answer
from tools.benchmarks.discovery.figures import FOUND, Rate, of_kind, quantile, rate
from tools.benchmarks.discovery.result import Result
from tools.benchmarks.record import Figure

_HARD: Final = ("backlash", "slack_cable")  # these have lower goals


def goals(results: Sequence[Result]) -> tuple[Figure, ...]:
    """Return all figures with at least one case."""
    parts = _of_errors(results), _of_finding(results), _of_values(results), _of_time(results)
    return tuple(figure for part in parts for figure in part if figure is not None)


def at_least(what: str, wanted: float, found: Rate) -> Figure | None:
    """Return the figure of a rate, 0 to 1, with a lower bound."""
    return _rate(what, found, at_least=100 * wanted)


def at_most(what: str, wanted: float, found: Rate) -> Figure | None:
    """Return the figure of a rate, 0 to 1, with an upper bound."""
    return _rate(what, found, at_most=100 * wanted)


def _rate(what: str, found: Rate, at_least: float | None = None, at_most: float | None = None) -> Figure | None:
    if not found.n:
        return None
    low, high = found.interval
    return Figure(what, 100 * found.value, "%", at_least, at_most, interval=(100 * low, 100 * high), n=found.n)


def _below(what: str, wanted: float, unit: str, value: float, n: int) -> Figure | None:
    return Figure(what, value, unit, at_most=wanted, n=n) if n else None


def _of_time(results: Sequence[Result]) -> Iterator[Figure | None]:
    eight = [result for result in results if result.plan.runs == 8 and math.isfinite(result.seconds)]
    seconds, memory = [result.seconds for result in eight], [result.memory for result in eight]
    what, n = "diagnosis of eight recordings", len(eight)
    yield _below(f"{what}: processor time, median", 8.0, "s", quantile(seconds, 0.5), n)
    yield _below(f"{what}: processor time, of 99 %", 30.0, "s", quantile(seconds, 0.99), n)
    yield _below(f"{what}: memory, the most", 1.0, "GiB", quantile(memory, 1.0) / 1024, n)


def _of_finding(results: Sequence[Result]) -> Iterator[Figure | None]:
    one = of_kind(results, "one")
    visible, small = [r for r in one if r.plan.size != "small"], [r for r in one if r.plan.size == "small"]
    by_effect = figures.found_by_effect(visible)
    others = [(name, of) for name, of in by_effect.items() if name not in _HARD]
    yield at_least("hidden effect, medium or large: named or in a true set", 0.95, rate(visible, *FOUND))
    for name, found in others[:1]:
        yield at_least(f"hidden effect, medium or large, the least often found: `{name}`", 0.85, found)
    for name in _HARD:
        yield at_least(f"hidden effect, medium or large: `{name}`", 0.8, by_effect.get(name, Rate(0, 0)))
    yield at_least("hidden effect, small: named or in a true set", 0.8, rate(small, *FOUND))
    yield at_least("two hidden effects: exactly these are named", 0.85, rate(of_kind(results, "pairs"), Answer.RIGHT))


def _of_errors(results: Sequence[Result]) -> Iterator[Figure | None]:
    clean, outside = of_kind(results, "clean"), of_kind(results, "outside")
    alarms = Rate.of(result.answer is not Answer.RIGHT for result in clean)
    yield at_most("a wrong cause or joint is named, whatever is hidden", 0.005, rate(results, Answer.WRONG_CAUSE))
    yield at_most("nothing hidden: a verdict other than `adequate`", 0.005, alarms)
    what = "hidden effect outside of the library: `unknown`, or not complete"
    yield at_least(what, 0.95, rate(outside, Answer.RIGHT))


def _of_values(results: Sequence[Result]) -> Iterator[Figure | None]:
    covered = Rate.of(estimate.is_covered for estimate in figures.estimates(results))
    stated, shares = figures.bins(results), figures.closed_shares(results)
    yield _rate("values of hidden effects inside their 95 % intervals", covered, at_least=90, at_most=98)
    what = "relative fit of sets, taken as probability: expected calibration error"
    yield _below(what, 0.03, "", figures.expected_error(stated), sum(true.n for _, true in stated))
    if shares:
        what = "a cause is named: closed share of the open-loop distance, median"
        yield Figure(what, 100 * quantile(shares, 0.5), "%", at_least=90, n=len(shares))
