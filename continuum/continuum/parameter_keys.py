"""Keys of parameters in files: some quantities have two names, and a key may end in its unit, as ``twist_deg``."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal

from continuum.errors import InvalidValueError

_SYNONYMS = {"b": "half_spacing", "a": "hole_radius", "link_mass": "mass", "link_inertia": "inertia"}
"""What arm files and model files call the same quantities; both kinds of file take both names."""

_OTHER_NAME = _SYNONYMS | {long: short for short, long in _SYNONYMS.items()}

_TO_SI: dict[str, tuple[str, Callable[[float], float]]] = {
    "deg": ("rad", math.radians),
    "mm": ("m", lambda value: float(Decimal(repr(value)).scaleb(-3))),
    "g": ("kg", lambda value: float(Decimal(repr(value)).scaleb(-3))),
}
"""Units that are converted: the SI unit of each, and how; as decimals, so that 19.3 mm are 0.0193 m to the last bit."""


@dataclass(frozen=True)
class GivenValues:
    """A block of a file.

    Attributes:
        values: by the names of the specifications, in SI units; what is unknown, by the keys of the file.
        keys: the key in the file, by the same names.
        written: values as the file has them, by the same names.
    """

    values: dict[str, object]
    keys: dict[str, str]
    written: dict[str, object]

    def as_written(self, error: InvalidValueError, prefix: str) -> InvalidValueError:
        """The error of a value, with the key and the unit that the file has.

        Args:
            error: of ``prefix`` and a name in ``values``, or of an item or a part of that value.
            prefix: of the block.
        """
        for name, key in self.keys.items():
            rest = error.name.removeprefix(prefix + name)
            if key == name or rest == error.name or rest[:1] not in ("", "[", "."):
                continue
            if not _has_unit(key, name):
                return InvalidValueError(f"{prefix}{key}{rest}", error.value, error.allowed)
            unit = key.rpartition("_")[2]
            value = self.written[name]
            if rest[:1] == "[" and isinstance(value, list):
                value = value[int(rest[1:].partition("]")[0])]
            return InvalidValueError(f"{prefix}{key}{rest}", value, f"in {unit}, the same as {error.allowed}")
        return error


def given_values(
    block: Mapping[str, object], units: Mapping[str, str], prefix: str, *, with_units: bool = True
) -> GivenValues:
    """The values of a block by the names of their specifications.

    Args:
        block: as a file has it.
        units: SI unit of each known parameter, by its name.
        prefix: put before a name in messages.
        with_units: whether keys may end in a unit; the values of such keys are converted to SI.

    Raises:
        InvalidValueError: two keys for one quantity; the message names both.
    """
    given = GivenValues({}, {}, {})
    for written, value in block.items():
        key = str(written)
        name = name_of(key, units)
        unit = ""
        if name is None and with_units:
            stem, _, unit = key.rpartition("_")
            name = name_of(stem, units)
            if name is None or _TO_SI.get(unit, ("",))[0] != units[name] or not units[name]:
                name, unit = None, ""
        name = key if name is None else name
        if name in given.keys:
            allowed = f"one name for a quantity; {prefix}{given.keys[name]} gives it too"
            raise InvalidValueError(f"{prefix}{key}", value, allowed)
        given.values[name] = in_si(value, unit) if unit else value
        given.keys[name] = key
        given.written[name] = value
    return given


def name_of(key: str, names: Iterable[str]) -> str | None:
    """The one of ``names`` that a key without a unit means; None where it means none of them."""
    known = tuple(names)
    other = _OTHER_NAME.get(key)
    return key if key in known else other if other in known else None


def known_keys(units: Mapping[str, str]) -> list[str]:
    """All keys that `given_values` knows: names, other names, and both with units."""
    si_units = dict(units) | {_OTHER_NAME[name]: si for name, si in units.items() if name in _OTHER_NAME}
    with_unit = [f"{name}_{unit}" for name, si in si_units.items() for unit in units_for(si)[1:]]
    return [*si_units, *with_unit]


def common_name(name: str) -> str:
    """The longer one of a quantity's two names; the name itself where it has no other."""
    return _SYNONYMS.get(name, name)


def convertible(unit: object, si_unit: str) -> bool:
    """Whether values in ``unit`` are converted to ``si_unit``."""
    return isinstance(unit, str) and unit in _TO_SI and _TO_SI[unit][0] == si_unit


def units_for(si_unit: str) -> list[str]:
    """Units in which a value may be given: SI, and those that are converted to it."""
    return [si_unit, *(unit for unit, (si, _) in _TO_SI.items() if si == si_unit)]


def in_si(value: object, unit: str) -> object:
    """A number, or each number of a list, in SI units; anything else as it is, to be refused by its specification."""
    if isinstance(value, list):
        return [in_si(item, unit) for item in value]
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) <= sys.float_info.max:
        return value
    return _TO_SI[unit][1](value)


def _has_unit(key: str, name: str) -> bool:
    return key not in (name, _OTHER_NAME.get(name))
