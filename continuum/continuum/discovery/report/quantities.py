"""Values for readers: angles in degrees, ratios in percent, no more digits than their intervals support."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from continuum.dynamics.parameters import RATIO
from continuum.languages import ENGLISH, Translator
from continuum.significant_digits import rounded

_DEGREES: Final = 180 / math.pi
_UNITS: Final = {
    "rad": (_DEGREES, "°"),
    "rad/s": (_DEGREES, "°/s"),
    "rad/(N m)": (_DEGREES, "°/(N m)"),
    "s": (1e3, "ms"),
    "m": (1e3, "mm"),
    "1": (1.0, ""),
}
"""Factors and units in place of SI ones. Per-radian units stay, as data sheets give stiffness in them."""
_EXPONENTS: Final = str.maketrans("23", "²³")


class Scale(NamedTuple):
    """Factor by which an SI value is multiplied, and the resulting unit."""

    factor: float
    unit: str

    def __call__(self, value: float) -> float:
        return self.factor * value


def scale_of(unit: str, meaning: str, name: str = "") -> Scale:
    """Return the scale in which values of a parameter are shown.

    Args:
        unit: SI unit.
        meaning: meaning of the parameter; a ratio minus one is shown in percent.
        name: name of the parameter; a frequency is shown in Hz.
    """
    if unit == "1" and meaning.endswith(RATIO):
        return Scale(100.0, "%")
    if unit == "rad/s" and name.endswith("frequency"):
        return Scale(1 / math.tau, "Hz")
    return Scale(*_UNITS.get(unit, (1.0, unit.translate(_EXPONENTS))))


def meaning_in_words(meaning: str, tr: Translator = ENGLISH) -> str:
    """Return the meaning of a parameter; that of a ratio minus one is shortened to the comparison."""
    if not meaning.endswith(RATIO):
        return tr(meaning)
    return tr(meaning.removesuffix(RATIO))


def decimals_of(step: float, digits: int = 2) -> int:
    """Return the decimal places that show so many digits of a step; 0 for a step that is not finite and positive."""
    if not (math.isfinite(step) and step > 0):
        return 0
    return min(max(digits - 1 - math.floor(math.log10(step)), 0), 12)


def number(value: float, digits: int = 3) -> str:
    """Format with so many significant digits and no exponent below 100000; a dash if the value is not finite."""
    if not math.isfinite(value):
        return "–"
    return with_decimals(value, decimals_of(abs(value), digits))


def bound(value: float, tr: Translator = ENGLISH) -> str:
    """Format to three digits without trailing zeros; "none" if infinite."""
    return rounded(value, 3).replace("-", "−") if math.isfinite(value) else tr("none")


def with_decimals(value: float, decimals: int) -> str:
    """Format with so many decimal places and a true minus sign."""
    if abs(value) >= 1e5 or (value and abs(value) < 1e-6):
        return f"{value:.3g}".replace("-", "−")
    text = f"{value:.{decimals}f}"
    return (text.lstrip("-") if float(text) == 0 else text).replace("-", "−")


def with_interval(value: float, low: float, high: float, tr: Translator = ENGLISH, digits: int = 2) -> tuple[str, str]:
    """Format a value and its interval, "low to high", to so many digits of its half-width; a dash if there is none."""
    if not (math.isfinite(low) and math.isfinite(high) and high > low):
        return number(value), "–"
    places = decimals_of((high - low) / 2, digits)
    interval = from_to(with_decimals(low, places), with_decimals(high, places), tr)
    return with_decimals(value, places), interval


def from_to(low: str, high: str, tr: Translator = ENGLISH) -> str:
    """Write a range."""
    return tr("{low} to {high}", low=low, high=high)


def percent(part: float, tr: Translator = ENGLISH) -> str:
    """Format a fraction in whole percent, without sign; never 0 or 100, which would claim certainty."""
    if not math.isfinite(part):
        return "–"
    rounded = round(100 * part)
    return _under(1, tr) if rounded < 1 else _over(99, tr) if rounded > 99 else f"{rounded}"


def percent_interval(low: float, high: float, tr: Translator = ENGLISH) -> str:
    """Format the interval of a fraction in percent; a dash if none is known."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return "–"
    first, last = percent(low, tr), percent(high, tr)
    return first if first == last else from_to(first, last, tr)


def tenths(part: float, tr: Translator = ENGLISH) -> str:
    """Format a fraction in percent, rounded to ten; never 0 or 100, which would claim certainty."""
    rounded = 10 * round(10 * part)
    return f"{rounded}" if 0 < rounded < 100 else _under(10, tr) if part < 0.5 else _over(90, tr)


def _under(limit: int, tr: Translator) -> str:
    return tr("under {limit}", limit=limit)


def _over(limit: int, tr: Translator) -> str:
    return tr("over {limit}", limit=limit)
