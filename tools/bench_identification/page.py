"""The page of the comparison; every figure is computed from what was measured."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from continuum.identification.fit import THESIS_PARAMETERS
from tools.bench_identification.arms import MeasuredArm
from tools.bench_identification.two_ways import Answer
from tools.markdown import paragraph, table

MOST_SECONDS, LEAST_RATIO, LONGEST_DIAGNOSIS = 10.0, 20.0, 120.0


@dataclass(frozen=True)
class Comparison:
    """One arm, identified twice."""

    arm: MeasuredArm
    slopes: Answer
    swarm: Answer

    @property
    def ratio(self) -> float:
        """Simulations of the swarm for each one of the fit."""
        return self.swarm.simulations / self.slopes.simulations


@dataclass(frozen=True)
class Diagnosed:
    """A whole diagnosis.

    Attributes:
        seconds: by the wall's clock, from the call to the answer.
        verdict: what it said.
    """

    seconds: float
    verdict: str


def page(compared: Sequence[Comparison], diagnosed: Diagnosed) -> str:
    """The whole page."""
    parts = [
        "# Identification",
        paragraph(
            "Made by `make bench-identification` on arms of the blind tests' plant (MuJoCo, true dry friction, every",
            "joint a little different, sensors' noise), with nothing hidden: four releases of 1.6 s each, from which",
            "the thesis's five parameters are identified, by the library's fit with slopes and by the thesis's",
            "particle swarm (Table 2, Eq. 19). Truth is the mean over an arm's joints.",
        ),
        table(("", "goal", "reached", ""), goals(compared, diagnosed)),
        "## Effort",
        table(
            ("arm", "simulations, fit", "simulations, swarm", "ratio", "seconds, fit", "seconds, swarm"),
            [
                (i, c.slopes.simulations, c.swarm.simulations, f"{c.ratio:.0f}", f"{c.slopes.seconds:.1f}",
                 f"{c.swarm.seconds:.1f}")
                for i, c in enumerate(compared, start=1)
            ],
        ),
        paragraph(
            "A simulation of the fit is one whole run, in windows, with slopes by all unknowns and first states.",
        ),
        "## Errors",
        table(
            ("parameter", "fit, median", "fit, worst", "swarm, median", "swarm, worst"),
            [(name, *_errors(compared, name)) for name in THESIS_PARAMETERS],
        ),
        paragraph(
            "The swarm starts every run at rest from its first measured angles, so that their noise is in all of a",
            "run; the fit finds first states with the rest. It needs one start: from wrong ones on all sides it ends",
            "in the same place; where that is to be made sure of, `identification/several_starts.py` begins all over",
            "the prior, within the bounds, and the best start goes on. Discovery begins every effect that contends",
            "from several places",
            "(`discovery/other_beginnings.py`), and effects that have valleys of their own name",
            "where to begin (`continuum.discovery.likeliest_beginning`). The two `stribeck_` parameters are",
            "of the friction between sliding and rest, which shows only where a joint comes to rest.",
        ),
        f"Processor: {platform.machine()}, Python {platform.python_version()}.",
    ]  # fmt: skip
    return "\n\n".join(parts) + "\n"


def goals(compared: Sequence[Comparison], diagnosed: Diagnosed) -> list[tuple[str, str, str, str]]:
    """What is wanted and what was reached, in the worst case."""
    slowest, least = max(c.slopes.seconds for c in compared), min(c.ratio for c in compared)
    return [
        ("five parameters from four runs", f"{MOST_SECONDS:g} s", f"{slowest:.1f} s", _met(slowest <= MOST_SECONDS)),
        ("simulations of the swarm for one", f"{LEAST_RATIO:g}", f"{least:.0f}", _met(least >= LEAST_RATIO)),
        (
            f"diagnosis of eight runs of 1.6 s by two processes (`{diagnosed.verdict}`)",
            f"{LONGEST_DIAGNOSIS:g} s",
            f"{diagnosed.seconds:.0f} s",
            _met(diagnosed.seconds <= LONGEST_DIAGNOSIS),
        ),
    ]


def _met(is_met: bool) -> str:
    return "met" if is_met else "**missed**"


def _errors(compared: Sequence[Comparison], name: str) -> list[str]:
    found = []
    for way in ("slopes", "swarm"):
        errors = [abs(getattr(c, way).errors(c.arm.truth)[name]) for c in compared]
        found += [f"{100 * value:.1f} %" for value in (median(errors), max(errors))]
    return found
