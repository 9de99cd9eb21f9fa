"""Values as people read them: angles in degrees, factors in percent, no more digits than their intervals allow."""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from continuum.dynamics.parameters import RATIO

_DEGREES: Final = 180 / math.pi
_UNITS: Final = {
    "rad": (_DEGREES, "°"),
    "rad/s": (_DEGREES, "°/s"),
    "rad/(N m)": (_DEGREES, "°/(N m)"),
    "s": (1e3, "ms"),
    "m": (1e3, "mm"),
    "1": (1.0, ""),
}
"""Factors and units in the place of SI ones. Per-radian units stay: stiffness is given so on data sheets."""
_EXPONENTS: Final = str.maketrans("23", "²³")


class Scale(NamedTuple):
    """By what an SI value is multiplied, and the unit that it has then."""

    factor: float
    unit: str

    def __call__(self, value: float) -> float:
        return self.factor * value


def scale_of(unit: str, meaning: str, name: str = "") -> Scale:
    """How values of a parameter are shown.

    Args:
        unit: SI.
        meaning: of the parameter; a ratio less one is shown in percent.
        name: of the parameter; a frequency is shown in Hz.
    """
    if unit == "1" and meaning.endswith(RATIO):
        return Scale(100.0, "%")
    if unit == "rad/s" and name.endswith("frequency"):
        return Scale(1 / math.tau, "Hz")
    return Scale(*_UNITS.get(unit, (1.0, unit.translate(_EXPONENTS))))


def meaning_in_words(meaning: str) -> str:
    """The meaning of a parameter; of a ratio less one, which is shown in percent, as a comparison."""
    if not meaning.endswith(RATIO):
        return meaning
    return meaning.removesuffix(RATIO).replace(" by ", " compared with ", 1)


def decimals_of(step: float, digits: int = 2) -> int:
    """Decimal places that show so many digits of a step; none of one that is 0 or not finite."""
    if not (math.isfinite(step) and step > 0):
        return 0
    return min(max(digits - 1 - math.floor(math.log10(step)), 0), 12)


def number(value: float, digits: int = 3) -> str:
    """With so many significant digits and without exponents up to 100000; a dash where there is none."""
    if not math.isfinite(value):
        return "–"
    return with_decimals(value, decimals_of(abs(value), digits))


def bound(value: float) -> str:
    """To three digits, without zeros at the end."""
    return f"{float(f'{value:.3g}'):g}".replace("-", "−") if math.isfinite(value) else "none"


def with_decimals(value: float, decimals: int) -> str:
    """With so many decimal places and a real minus sign."""
    if abs(value) >= 1e5 or (value and abs(value) < 1e-6):
        return f"{value:.3g}".replace("-", "−")
    text = f"{value:.{decimals}f}"
    return (text.lstrip("-") if float(text) == 0 else text).replace("-", "−")


def with_interval(value: float, low: float, high: float, digits: int = 2) -> tuple[str, str]:
    """Value and interval, "low to high", to so many digits of half of it; a dash where no interval is known."""
    if not (math.isfinite(low) and math.isfinite(high) and high > low):
        return number(value), "–"
    places = decimals_of((high - low) / 2, digits)
    return with_decimals(value, places), f"{with_decimals(low, places)} to {with_decimals(high, places)}"


def percent(part: float) -> str:
    """A part of one in whole percent, without sign; never 0 or 100, which would claim certainty."""
    if not math.isfinite(part):
        return "–"
    rounded = round(100 * part)
    return "under 1" if rounded < 1 else "over 99" if rounded > 99 else f"{rounded}"


def percent_interval(low: float, high: float) -> str:
    """An interval of a part of one in percent; a dash where none is known."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return "–"
    ends = percent(low), percent(high)
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def tenths(part: float) -> str:
    """A part of one in percent, to ten; never 0 or 100, which would claim certainty."""
    rounded = 10 * round(10 * part)
    return f"{rounded}" if 0 < rounded < 100 else "under 10" if part < 0.5 else "over 90"
