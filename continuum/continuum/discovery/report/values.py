"""Tables of values on the page of a diagnosis: from start to estimate, bounds, correlations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from continuum.discovery.report.names import capital, effect_in_words, parameter_in_words, value_in_words
from continuum.discovery.report.quantities import (
    bound,
    from_to,
    meaning_in_words,
    number,
    scale_of,
    with_decimals,
    with_interval,
)
from continuum.discovery.result import Cause, Diagnosis
from continuum.identification.estimate import Estimate
from continuum.languages import Translator


class ValueRow(NamedTuple):
    """A value of the model or of an effect."""

    name: str
    id: str
    meaning: str
    start: str
    value: str
    interval: str
    unit: str
    bounds: str
    is_at_bound: bool


class CorrelationRow(NamedTuple):
    """A value with its posterior correlations as text and number."""

    name: str
    id: str
    cells: list[tuple[str, float]]


def value_rows(result: Diagnosis, causes: Sequence[Cause], tr: Translator) -> list[ValueRow]:
    """Return the values of some effects."""
    return [_value(one, result, cause, tr) for cause in causes for one in cause.estimates]


def model_rows(result: Diagnosis, tr: Translator) -> list[ValueRow]:
    """Return the values of the model."""
    return [_value(one, result, None, tr) for one in result.estimates]


def correlation_rows(result: Diagnosis, tr: Translator) -> list[CorrelationRow]:
    """Return the correlations of the best set's values."""
    return [
        CorrelationRow(value_in_words(name, tr), name, [(with_decimals(float(r), 2), float(r)) for r in row])
        for name, row in zip(*result.correlation, strict=True)
    ]


def _value(one: Estimate, result: Diagnosis, cause: Cause | None, tr: Translator) -> ValueRow:
    scale = scale_of(one.unit, one.meaning, one.name)
    value, interval = with_interval(scale(one.value), scale(one.low), scale(one.high), tr)
    if cause is None:
        name = capital(parameter_in_words(one.name, one.joint, tr))
    else:
        joints = cause.joints if one.joint is None else (one.joint,)
        name = capital(effect_in_words(cause.effect, joints, result.n_joints, tr))
    if one.recording:
        name = tr("{value}, in {recording}", value=name, recording=one.recording)
    lower, upper = (bound(scale(end), tr) for end in (one.lower, one.upper))
    return ValueRow(
        name, str(replace(one, recording="")), meaning_in_words(one.meaning, tr), number(scale(one.start)), value,
        interval, scale.unit, from_to(lower, upper, tr),
        bool(one.is_at_bound) and one.value != one.start,
    )  # fmt: skip
