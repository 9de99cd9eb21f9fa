"""Where a fit of late sensors begins: the delay, of two in every row of tensions, that promises to explain most.

Tensions that hold from row to row jump at every row, and joints tell when. So a delay that is wrong by whole rows
explains the jumps while one that is wrong by half a row does not: slopes lead to the nearest such valley, which need
not be the deepest.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.discovery.candidate import Extension
from continuum.discovery.question import Question
from continuum.discovery.trial import Trial, fit_extension
from continuum.dynamics.effect_lookup import effect_named
from continuum.identification.free import Free

_IN_A_ROW = 2  # delays
_LONGEST = 3.0  # typical sizes
_ITERATIONS = 1


def with_likeliest_delay(question: Question, extension: Extension, near: Trial, steps: int) -> Trial:
    """The start of a fit, with a delay where the last effect has one that shifts what tensions do.

    Args:
        question: data and model.
        extension: to be fitted.
        near: a trial to start from, without the last effect.
        steps: of each window's first state, at most.
    """
    driven = [run.tensions for run in question.recordings if run.is_driven and run.tensions is not None]
    rows = [float(np.median(np.diff(tensions.times))) for tensions in driven if tensions.held]
    effect = effect_named(extension[-1].effect) if extension else None
    if effect is None or not effect.shifts_time or not rows:
        return near
    delays = [
        (name, parameter.typical)
        for name, parameter in effect.parameters.items()
        if parameter.typical is not None and np.any(effect.late({name: parameter.typical}))
    ]

    def late(name: str, typical: float, delay: float) -> Trial:
        return replace(
            near,
            unknowns=(*near.unknowns, Free(f"{effect.name}.{name}")),
            coordinates=np.append(near.coordinates, delay / typical),
            amounts=np.append(near.amounts, delay),
        )

    def hoped_for(start: Trial) -> float:
        fitted = fit_extension(question, extension, start, _ITERATIONS, 0, steps)
        return fitted.cost - fitted.promised

    starts = [
        late(name, typical, float(delay))
        for name, typical in delays
        for delay in np.arange(0.0, _LONGEST * typical, min(rows) / _IN_A_ROW)
    ]
    return min(starts, key=hoped_for, default=near)
