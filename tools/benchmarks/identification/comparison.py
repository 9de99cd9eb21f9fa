"""The library's fit and the thesis's swarm on the same arms, and their record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from continuum.identification.free import THESIS_PARAMETERS
from tools.benchmarks.identification.answers import Answer
from tools.benchmarks.record import Figure, Record, Table

MOST_ERROR = 0.05
"""Goal: largest relative error of a parameter."""

SWARM = "the thesis's swarm"


@dataclass(frozen=True)
class Comparison:
    """One arm, identified twice."""

    fit: Answer
    swarm: Answer


def record_of(compared: Sequence[Comparison]) -> Record:
    """Return the record of errors, times, validation errors, and coverage of the intervals."""
    seconds, position = (_medians(compared, name) for name in ("seconds", "position"))
    held = [one for c in compared for one in c.fit.held or ()]
    figures = [
        *(_worst(compared, k) for k in range(len(THESIS_PARAMETERS))),
        Figure("NRMSE of angles in validation, median", position[0], rival=SWARM, rival_value=position[1]),
        Figure("identification: processor time, median", seconds[0], "s", rival=SWARM, rival_value=seconds[1]),
    ]
    if held:
        inside = 100 * sum(held) / len(held)
        figures.append(Figure("identified values inside their 95 % intervals", inside, "%", n=len(held)))
    head = ("parameter", "fit, median error", "fit, worst", "swarm, median error", "swarm, worst")
    rows = [(name, *_cells(compared, k)) for k, name in enumerate(THESIS_PARAMETERS)]
    tables = {
        "errors": Table.of(head, rows),
        "whole": Table.of(
            ("", "fit", "swarm"),
            [
                ("processor time, median", *(f"{value:.1f} s" for value in seconds)),
                ("NRMSE of angles in validation, median", *(f"{value:.3f}" for value in position)),
                ("truth within 95 % intervals", f"{sum(held)} of {len(held)}", "no intervals"),
            ],
        ),
    }
    command = "make bench-identification"
    return Record("identification", command, tuple(figures), tables, (f"{len(compared)} arms.",))


def _worst(compared: Sequence[Comparison], k: int) -> Figure:
    (_, fit), (_, swarm) = _errors(compared, k)
    what = f"`{THESIS_PARAMETERS[k]}` identified: largest error"
    return Figure(what, 100 * fit, "%", at_most=100 * MOST_ERROR, rival=SWARM, rival_value=100 * swarm)


def _medians(compared: Sequence[Comparison], name: str) -> tuple[float, float]:
    fit, swarm = (median(getattr(getattr(c, method), name) for c in compared) for method in ("fit", "swarm"))
    return fit, swarm


def _errors(compared: Sequence[Comparison], k: int) -> list[tuple[float, float]]:
    """Median and largest error of a parameter by the fit, then by the swarm."""
    each = [abs(c.fit.errors[k]) for c in compared], [abs(c.swarm.errors[k]) for c in compared]
    return [(median(errors), max(errors)) for errors in each]


def _cells(compared: Sequence[Comparison], k: int) -> list[str]:
    return [f"{100 * value:.1f} %" for errors in _errors(compared, k) for value in errors]
