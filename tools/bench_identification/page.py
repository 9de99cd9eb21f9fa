"""The page of the comparison; every figure is computed from what was measured."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from continuum.identification.free import THESIS_PARAMETERS
from tools.bench_identification.arms import MeasuredArm
from tools.bench_identification.two_ways import Answer
from tools.markdown import paragraph, table

_BEFORE = paragraph(
    "The fit by multiple shooting that the library had before needed 3 to 4 s for the same five arms (seeds 900 to",
    "904) and had median errors of 1.3 % (stiffness), 1.2 % (viscous friction), 0.6 % (Coulomb friction), 2.0 %",
    "(Stribeck gain) and 0.2 % (Stribeck speed).",
)
MOST_SECONDS, LONGEST_DIAGNOSIS = 10.0, 120.0


@dataclass(frozen=True)
class Comparison:
    """One arm, identified twice."""

    arm: MeasuredArm
    smoothing: Answer
    swarm: Answer

    @property
    def ratio(self) -> float:
        """Time of the swarm by that of smoothing."""
        return self.swarm.seconds / self.smoothing.seconds


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
            "the thesis's five parameters are identified, by the library's smoothing and by the thesis's particle",
            "swarm (Table 2, Eq. 19). Truth is the mean over an arm's joints.",
        ),
        table(("", "goal", "reached", ""), goals(compared, diagnosed)),
        "## Effort",
        table(
            ("arm", "seconds, smoothing", "seconds, swarm", "ratio", "simulations, swarm"),
            [
                (i, f"{c.smoothing.seconds:.1f}", f"{c.swarm.seconds:.1f}", f"{c.ratio:.0f}", c.swarm.simulations)
                for i, c in enumerate(compared, start=1)
            ],
        ),
        paragraph(
            "Smoothing simulates nothing: it linearises Eq. 12 along the measured motion, with the derivatives by all",
            "parameters, and smooths again (`discovery/baseline.py`), so that simulations cannot be compared, as the",
            "former goal (20 of the swarm for one) did. Equations are compiled before for both ways.",
        ),
        "## Errors",
        table(
            ("parameter", "smoothing, median", "smoothing, worst", "swarm, median", "swarm, worst"),
            [(name, *_errors(compared, name)) for name in THESIS_PARAMETERS],
        ),
        paragraph(
            "The swarm starts every run at rest from its first measured angles, so that their noise is in all of a",
            "run; smoothing estimates the states with the rest, and allows for missing torque and for ordinary",
            "differences between parts of a batch. The two `stribeck_` parameters are of the friction between sliding",
            "and rest, which shows only where a joint comes to rest.",
        ),
        _BEFORE,
        f"Processor: {platform.machine()}, Python {platform.python_version()}.",
    ]  # fmt: skip
    return "\n\n".join(parts) + "\n"


def goals(compared: Sequence[Comparison], diagnosed: Diagnosed) -> list[tuple[str, str, str, str]]:
    """What is wanted and what was reached, in the worst case."""
    slowest = max(c.smoothing.seconds for c in compared)
    return [
        ("five parameters from four runs", f"{MOST_SECONDS:g} s", f"{slowest:.1f} s", _met(slowest <= MOST_SECONDS)),
        (
            f"diagnosis of eight runs of 1.6 s (`{diagnosed.verdict}`)",
            f"{LONGEST_DIAGNOSIS:g} s",
            f"{diagnosed.seconds:.0f} s",
            _met(diagnosed.seconds <= LONGEST_DIAGNOSIS),
        ),
    ]


def _met(is_met: bool) -> str:
    return "met" if is_met else "**missed**"


def _errors(compared: Sequence[Comparison], name: str) -> list[str]:
    found = []
    for way in ("smoothing", "swarm"):
        errors = [abs(getattr(c, way).errors(c.arm.truth)[name]) for c in compared]
        found += [f"{100 * value:.1f} %" for value in (median(errors), max(errors))]
    return found
