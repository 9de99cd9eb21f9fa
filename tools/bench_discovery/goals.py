"""What is wanted of the diagnosis, and whether it is reached."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

from tools.bench_discovery import figures
from tools.bench_discovery.answer import Answer
from tools.bench_discovery.figures import FOUND, Rate, of_kind, quantile, rate
from tools.bench_discovery.result import Result

MET, MISSED, NONE = "met", "**missed**", "no case"
_HARD: Final = ("backlash", "slack_cable")  # less is wanted of these


class Goal(NamedTuple):
    """What is wanted, how much, what came out of how many cases or values, and whether that is enough."""

    what: str
    wanted: str
    figure: str
    n: int
    is_met: bool

    @property
    def status(self) -> str:
        return NONE if not self.n else MET if self.is_met else MISSED


def goals(results: Sequence[Result]) -> list[Goal]:
    """All of them, those that are missed first."""
    lines = [*_of_time(results), *_of_finding(results), *_of_errors(results), *_of_values(results)]
    return sorted(lines, key=lambda goal: (MISSED, MET, NONE).index(goal.status))


def at_least(what: str, wanted: float, found: Rate) -> Goal:
    """A rate that shall be high."""
    return Goal(what, f">= {100 * wanted:g} %", str(found), found.n, found.value >= wanted)


def at_most(what: str, wanted: float, found: Rate) -> Goal:
    """A rate that shall be low."""
    return Goal(what, f"<= {100 * wanted:g} %", str(found), found.n, found.value <= wanted)


def _below(what: str, wanted: float, unit: str, value: float, n: int) -> Goal:
    return Goal(what, f"<= {wanted:g}{unit}", f"{value:.3g}{unit}" if n else "-", n, value <= wanted)


def _of_time(results: Sequence[Result]) -> list[Goal]:
    eight = [result for result in results if result.plan.runs == 8 and math.isfinite(result.seconds)]
    seconds, memory = [result.seconds for result in eight], [result.memory for result in eight]
    what, n = "one diagnosis of eight recordings", len(eight)
    return [
        _below(f"{what}: processor time, median", 8.0, " s", quantile(seconds, 0.5), n),
        _below(f"{what}: processor time, of 99 %", 30.0, " s", quantile(seconds, 0.99), n),
        _below(f"{what}: memory, the most", 1.0, " GiB", quantile(memory, 1.0) / 1024, n),
    ]


def _of_finding(results: Sequence[Result]) -> list[Goal]:
    one = of_kind(results, "one")
    visible, small = [r for r in one if r.plan.size != "small"], [r for r in one if r.plan.size == "small"]
    by_effect = figures.found_by_effect(visible)
    others = [(name, of) for name, of in by_effect.items() if name not in _HARD]
    return [
        at_least("one effect, medium or large: named or in a true set", 0.95, rate(visible, *FOUND)),
        *(at_least(f"of these, the least often found effect: `{n}`", 0.85, of) for n, of in others[:1]),
        *(at_least(f"of these, `{name}`", 0.8, by_effect.get(name, Rate(0, 0))) for name in _HARD),
        at_least("one effect, small: named or in a true set", 0.8, rate(small, *FOUND)),
    ]


def _of_errors(results: Sequence[Result]) -> list[Goal]:
    clean, outside = of_kind(results, "clean"), of_kind(results, "outside")
    alarms = Rate.of(result.answer is not Answer.RIGHT for result in clean)
    return [
        at_most("a wrong cause or joint is named, whatever is hidden", 0.005, rate(results, Answer.WRONG_CAUSE)),
        at_most("nothing hidden: anything but adequate", 0.005, alarms),
        at_least("outside of the library: unknown, or not complete", 0.95, rate(outside, Answer.RIGHT)),
    ]


def _of_values(results: Sequence[Result]) -> list[Goal]:
    covered = Rate.of(estimate.is_covered for estimate in figures.estimates(results))
    stated, shares = figures.bins(results), figures.closed_shares(results)
    low, middle, high = (100 * quantile(shares, part) for part in (0.25, 0.5, 0.75))
    closed = f"{middle:.1f} % ({low:.1f} to {high:.1f})" if shares else "-"
    what = "a cause is named: closed share of the open-loop distance, median (quartiles)"
    return [
        at_least("two effects: exactly these", 0.85, rate(of_kind(results, "pairs"), Answer.RIGHT)),
        Goal("95 % intervals hold the truth", "90 to 98 %", str(covered), covered.n, 0.90 <= covered.value <= 0.98),
        _below("probabilities of sets: ECE", 0.03, "", figures.expected_error(stated), sum(t.n for _, t in stated)),
        Goal(what, ">= 90 %", closed, len(shares), middle >= 90),
    ]
