"""Fitted parameters beside hidden amounts, where the plant's amount and the library's parameter are one quantity."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import median

from tools.bench_discovery.answer import is_it
from tools.bench_discovery.rate import Rate
from tools.bench_discovery.result import Result

SAME = {
    "rest_angle": ("angle",),
    "joint_stiffness": ("excess",),
    "tip_payload": ("mass",),
    "base_tilt": ("angle",),
    "base_compliance": ("compliance",),
    "joint_friction": ("coulomb", "viscous"),
    "load_friction": ("radius",),
    "backlash": ("gap",),
    "capstan": ("friction",),
    "slack_cable": ("slack",),
    "actuator_lag": ("lag",),
    "sensor_delay": ("delay",),
    "sensor_scale": ("gain",),
    "tension_scale": ("gain_1",),
}
"""Parameters of the library by effect whose value is the plant's amount: same unit, same sign."""


@dataclass(frozen=True)
class Estimate:
    """One fitted value.

    Attributes:
        parameter: `effect.parameter`.
        truth, value, low, high: hidden amount, fitted value and ends of its 95 % interval, in one unit.
    """

    parameter: str
    truth: float
    value: float
    low: float
    high: float

    @property
    def is_covered(self) -> bool:
        """Whether the interval holds the truth."""
        return self.low <= self.truth <= self.high

    @property
    def error(self) -> float:
        """Relative."""
        return abs(self.value - self.truth) / abs(self.truth)


def estimates(results: Iterable[Result]) -> list[Estimate]:
    """Values of hidden effects that were named at their joints, as the cause or first of an ambiguous set."""
    found = []
    for result in results:
        verdict = result.verdict
        if verdict is None or verdict["verdict"] not in ("cause", "ambiguous"):
            continue
        for hidden in result.hidden:
            for cause in verdict["causes"]:
                if not is_it(hidden, cause):
                    continue
                for name in SAME.get(hidden["name"], ()):
                    where = "" if hidden["joint"] is None else f"[{hidden['joint']}]"
                    value = cause["parameters"].get(name + where)
                    if value is not None:
                        numbers = value["value"], value["low"], value["high"]
                        found.append(Estimate(f"{hidden['name']}.{name}", hidden["amount"], *map(float, numbers)))
    return found


def coverage(some: Iterable[Estimate]) -> Rate:
    """How often intervals hold the truth."""
    return Rate.of(estimate.is_covered for estimate in some)


def median_error(some: Sequence[Estimate]) -> float:
    """Relative; NaN of none."""
    return median(estimate.error for estimate in some) if some else float("nan")


def by_parameter(some: Iterable[Estimate]) -> dict[str, list[Estimate]]:
    """Groups, those with the largest median error first."""
    groups: dict[str, list[Estimate]] = {}
    for estimate in some:
        groups.setdefault(estimate.parameter, []).append(estimate)
    return dict(sorted(groups.items(), key=lambda item: -median_error(item[1])))
