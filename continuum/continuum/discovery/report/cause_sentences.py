"""What is wrong with the arm, where and by how much: one sentence for each cause."""

from __future__ import annotations

from typing import Final

from continuum.discovery.report.quantities import meaning_in_words, scale_of, with_interval
from continuum.discovery.result import Cause
from continuum.discovery.words import matter_in_words, places
from continuum.identification.estimate import Estimate
from continuum.languages import Translator

_MOST: Final = 2
"""Most values in a sentence."""


def matter_with_value(cause: Cause, tr: Translator) -> str:
    """Say what is wrong, where, and how large it is if one or two numbers show that; without a full stop."""
    shown = cause.estimates if len(cause.estimates) <= _MOST else ()
    details = [places(cause, tr), *(_value(one, len(shown) == 1, tr) for one in shown)]
    text = ", ".join(filter(None, details))
    return matter_in_words(cause, tr).rstrip(".") + (f" ({text})" if text else "")


def _value(one: Estimate, is_alone: bool, tr: Translator) -> str:
    scale = scale_of(one.unit, one.meaning, one.name)
    value, interval = with_interval(scale(one.value), scale(one.low), scale(one.high), tr, digits=1)
    unit = scale.unit if scale.unit.startswith("°") or not scale.unit else f" {scale.unit}"
    what = "" if scale.unit and is_alone else f"{meaning_in_words(one.meaning, tr)}: "
    sign = "+" if scale.unit == "%" and one.value > 0 else ""
    size, ends = f"{what}{sign}{value}{unit}", f"{interval}{unit}"
    return size if interval == "–" else tr("{size}, 95 % interval {interval}", size=size, interval=ends)
