"""From results to figures: rates, times, estimates, calibration."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Final, NamedTuple

from blind.mujoco_plant import LIBRARY
from scipy.stats import binomtest

from tools.benchmarks.discovery.answer import Answer, is_exactly, is_it
from tools.benchmarks.discovery.result import Result

FOUND: Final = (Answer.RIGHT, Answer.SET)
WRONG: Final = (Answer.WRONG_CAUSE, Answer.WRONG_SET)
SAME: Final = {
    "rest_angle": {"angle": 1.0},
    "joint_stiffness": {"excess": 1.0},
    "inertia": {"mass": 1.0, "inertia": 2.0},
    "tip_payload": {"mass": 1.0},
    "base_tilt": {"angle": 1.0},
    "base_compliance": {"compliance": 1.0},
    "joint_friction": {"coulomb": 1.0, "viscous": 1.0},
    "load_friction": {"radius": 1.0},
    "backlash": {"gap": 1.0},
    "capstan": {"friction": 1.0},
    "slack_cable": {"slack": 1.0},
    "actuator_lag": {"lag": 1.0},
    "sensor_delay": {"delay": 1.0},
    "sensor_scale": {"gain": 1.0},
    "tension_scale": {"gain_1": 1.0, "gain_2": 0.5},
}
"""Library parameter of each effect that corresponds to the plants' amount, and its factor."""
_BINS = 10


class Rate(NamedTuple):
    """``k`` of ``n`` cases."""

    k: int
    n: int

    @classmethod
    def of(cls, happened: Iterable[bool]) -> Rate:
        each = list(happened)
        return cls(sum(each), len(each))

    @property
    def value(self) -> float:
        """Rate from 0 to 1; NaN without cases."""
        return self.k / self.n if self.n else math.nan

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % interval of a rate of at least one case."""
        ends = binomtest(self.k, self.n).proportion_ci(0.95, method="wilson")
        return float(ends.low), float(ends.high)

    def __str__(self) -> str:
        if not self.n:
            return "-"
        low, high = self.interval
        return f"{100 * self.value:.1f} % ({100 * low:.1f} to {100 * high:.1f})"


class Estimate(NamedTuple):
    """A value of an effect with its 95 % interval, and the hidden value."""

    parameter: str
    truth: float
    value: float
    low: float
    high: float

    @property
    def is_covered(self) -> bool:
        """Whether the interval contains the truth."""
        return self.low <= self.truth <= self.high


def rate(results: Iterable[Result], *answers: Answer) -> Rate:
    """Return the rate of certain answers."""
    return Rate.of(result.answer in answers for result in results)


def of_kind(results: Iterable[Result], kind: str) -> list[Result]:
    """Return the results of the kind `clean`, `one`, `pairs` or `outside`."""
    return [result for result in results if result.plan.kind == kind]


def found_by_effect(results: Iterable[Result]) -> dict[str, Rate]:
    """Return the rate at which each effect, hidden alone, is named or in a true set, the lowest rate first."""
    one = of_kind(results, "one")
    rates = {name: rate((r for r in one if r.plan.effects == (name,)), *FOUND) for name in LIBRARY}
    return dict(sorted(((name, of) for name, of in rates.items() if of.n), key=lambda item: item[1].value))


def quantile(values: Iterable[float], part: float) -> float:
    """Return the smallest value that at least a fraction of the values do not exceed; NaN without values."""
    ordered = sorted(value for value in values if math.isfinite(value))
    return ordered[max(0, math.ceil(part * len(ordered)) - 1)] if ordered else math.nan


def closed_shares(results: Iterable[Result]) -> list[float]:
    """Return the closed fractions of the distance between open-loop error and noise in cases with a named cause."""
    verdicts = (result.verdict for result in results)
    return [float(v["closed"]["value"] or 0.0) for v in verdicts if v is not None and v["verdict"] == "cause"]


def estimates(results: Iterable[Result]) -> list[Estimate]:
    """Return the values of hidden effects that the most probable set names at their joints."""
    found = []
    for result in results:
        named = [(h, cause) for one in result.sets[:1] for cause in one["effects"] for h in result.hidden]
        for hidden, cause in (both for both in named if is_it(*both)):
            for one in cause["parameters"]:
                factor = SAME.get(hidden["name"], {}).get(one["name"].partition(".")[2])
                numbers = one["value"], one["low"], one["high"]
                if factor is not None and None not in numbers and one["joint"] in (None, hidden["joint"]):
                    found.append(Estimate(one["name"], factor * hidden["amount"], *map(float, numbers)))
    return found


def bins(results: Iterable[Result]) -> list[tuple[float, Rate]]:
    """Return for ten bins of the stated probabilities of named sets their mean, and the rate of true sets."""
    groups: list[list[tuple[float, bool]]] = [[] for _ in range(_BINS)]
    for result in results:
        for one in result.sets:
            p = float(one["relative_fit"])
            groups[min(int(_BINS * p), _BINS - 1)].append((p, is_exactly(result.hidden, one["effects"])))
    return [(sum(p for p, _ in g) / len(g), Rate.of(true for _, true in g)) for g in groups if g]


def expected_error(some: Sequence[tuple[float, Rate]]) -> float:
    """Return the expected calibration error: mean |probability - rate|, weighted by bin size (Naeini 2015), or NaN."""
    n = sum(true.n for _, true in some)
    return sum(true.n * abs(stated - true.value) for stated, true in some) / n if n else math.nan
