"""Where the fit of an effect begins whose slopes lead to the nearest of many valleys: wherever promises most.

Late sensors have a valley in every row. Tensions that hold from row to row jump at every row, and joints tell when: a
delay that is wrong by whole rows explains the jumps while one that is wrong by half a row does not. So two delays in
every row are tried. Other effects name beginnings of their own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from continuum.discovery.candidate import USUAL, Extension
from continuum.discovery.question import Question
from continuum.discovery.trial import Trial, fit_extension
from continuum.dynamics.effect import Effect
from continuum.dynamics.effect_lookup import effect_named
from continuum.identification.free import Free

_IN_A_ROW = 2  # delays
_LONGEST = 3.0  # typical sizes
_ITERATIONS = 2


def with_likeliest_beginning(
    question: Question, extension: Extension, near: Trial, steps: int, part: float = USUAL
) -> Trial:
    """The start of a fit: values of the last effect, where it names some or is late, that promise to explain most.

    Args:
        question: data and model.
        extension: to be fitted.
        near: a trial to start from; one with the last effect is the start.
        steps: of each window's first state, at most.
        part: of a typical size, at which it begins that is not named.
    """
    if not extension:
        return near
    effect = effect_named(extension[-1].effect)
    if any(unknown.name.startswith(f"{effect.name}.") for unknown in near.unknowns):
        return near

    def hoped_for(start: Trial) -> float:
        fitted = fit_extension(question, extension, start, _ITERATIONS, 0, steps, part=part)
        return fitted.cost - fitted.promised

    starts = [_begun(near, effect, values) for values in (*effect.beginnings, *_delays(question, effect))]
    return min(starts, key=hoped_for, default=near)


def _delays(question: Question, effect: Effect) -> Iterator[Mapping[str, float]]:
    """Delays to begin with, of an effect that has any."""
    driven = [run.tensions for run in question.recordings if run.is_driven and run.tensions is not None]
    rows = [float(np.median(np.diff(tensions.times))) for tensions in driven if tensions.held]
    if not effect.shifts_time or not rows:
        return
    for name, typical in delays_of(effect).items():
        for delay in np.arange(0.0, _LONGEST * typical, min(rows) / _IN_A_ROW):
            yield {name: float(delay)}


def delays_of(effect: Effect) -> dict[str, float]:
    """Parameters of an effect by which sensors are late, and their typical sizes [s]."""
    sizes = {name: parameter.typical for name, parameter in effect.parameters.items() if parameter.typical is not None}
    return {name: typical for name, typical in sizes.items() if np.any(effect.late({name: typical}))}


def _begun(near: Trial, effect: Effect, values: Mapping[str, float]) -> Trial:
    """A trial with the effect at some values of its parameters."""
    moved = {name: value - (effect.parameters[name].default or 0.0) for name, value in values.items()}
    units = [effect.parameters[name].typical or 1.0 for name in moved]
    return replace(
        near,
        unknowns=(*near.unknowns, *(Free(f"{effect.name}.{name}") for name in moved)),
        coordinates=np.append(near.coordinates, [by / unit for by, unit in zip(moved.values(), units, strict=True)]),
        amounts=np.append(near.amounts, list(moved.values())),
    )
