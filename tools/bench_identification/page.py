"""The page of the comparison; every figure is computed from what was measured."""

from __future__ import annotations

import platform
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import median

from continuum.identification.free import THESIS_PARAMETERS
from tools.bench_identification.answers import Answer
from tools.markdown import paragraph, table

MOST_ERROR = 0.05
"""Goal: no parameter is off by more."""


@dataclass(frozen=True)
class Comparison:
    """One arm, identified twice."""

    fit: Answer
    swarm: Answer


def page(compared: Sequence[Comparison]) -> str:
    """The whole page."""
    held = [one for c in compared for one in c.fit.held or ()]
    parts = [
        "# Identification",
        paragraph(
            f"Made by `make bench-identification` on {len(compared)} arms of the blind tests' plant (MuJoCo, true dry",
            "friction, every joint a little different, sensors' noise), with nothing hidden. Of each arm's eight",
            "releases of 1.6 s, runs 1, 2, 5 and 8 identify the thesis's five parameters, by `continuum identify` and",
            "by its `--method swarm`, the thesis's particle swarm (Table 2, Eq. 19); runs 3, 4, 6 and 7 validate.",
            "Truth is the mean over an arm's joints.",
        ),
        table(
            ("parameter", "fit, median error", "fit, worst", "swarm, median error", "swarm, worst"),
            [(name, *_errors(compared, k)) for k, name in enumerate(THESIS_PARAMETERS)],
        ),
        table(
            ("", "fit", "swarm"),
            [
                ("processor time, median", *(f"{median(x):.1f} s" for x in _both(compared, "seconds"))),
                ("NRMSE of angles in validation, median", *(f"{median(x):.3f}" for x in _both(compared, "position"))),
                ("truth within 95 % intervals", f"{sum(held)} of {len(held)}", "no intervals"),
            ],
        ),
        paragraph(
            "The fit is by maximum likelihood: half-second segments are simulated open loop by Eq. 12, with their",
            "initial angles, rates and zeros of the sensors among the unknowns, and Levenberg-Marquardt steps start",
            "from six guesses of the friction near rest (`continuum/discovery/parameter_fit.py`). The swarm starts",
            "every run at rest from its first measured angles, so that their noise is in all of a run.",
        ),
        f"Processor: {platform.machine()}, Python {platform.python_version()}.",
    ]  # fmt: skip
    return "\n\n".join(parts) + "\n"


def goals(compared: Sequence[Comparison]) -> Iterator[str]:
    """How many parameters of the fit are as near to the truth as they should be, one line a parameter."""
    for k, name in enumerate(THESIS_PARAMETERS):
        near = sum(abs(c.fit.errors[k]) <= MOST_ERROR for c in compared)
        yield f"{name}: within {100 * MOST_ERROR:g} % in {near} of {len(compared)} arms"


def _both(compared: Sequence[Comparison], name: str) -> list[list[float]]:
    return [[getattr(getattr(c, method), name) for c in compared] for method in ("fit", "swarm")]


def _errors(compared: Sequence[Comparison], k: int) -> list[str]:
    found = []
    for errors in ([abs(c.fit.errors[k]) for c in compared], [abs(c.swarm.errors[k]) for c in compared]):
        found += [f"{100 * value:.1f} %" for value in (median(errors), max(errors))]
    return found
