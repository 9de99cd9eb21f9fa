"""Specification of a named parameter: type, unit, range and description, shared by files, nodes and messages."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from continuum.errors import InvalidValueError

Scalar = int | float | str | bool
Value = Scalar | list[Scalar]

_TYPE_NAMES = {int: "a whole number", float: "a finite number", str: "a text", bool: "true or false"}


@dataclass(frozen=True)
class ParameterSpec:
    """One parameter.

    Attributes:
        name: name in files and on the command line.
        kind: type of the value, or of the items if ``is_list``.
        description: one sentence without the unit.
        unit: SI unit, empty for a pure number.
        lower, upper: bounds, inclusive unless ``lower_open``; ignored for texts.
        lower_open: whether the lower bound is excluded.
        is_list: whether the value is a list of ``kind``.
        default: default value; None makes the parameter required.
        choices: the allowed texts; empty allows any text.
    """

    name: str
    kind: type
    description: str
    unit: str = ""
    lower: float = -math.inf
    upper: float = math.inf
    lower_open: bool = False
    is_list: bool = False
    default: Scalar | Sequence[Scalar] | None = None
    choices: tuple[str, ...] = ()

    @property
    def allowed(self) -> str:
        """The allowed values in words."""
        words = _TYPE_NAMES[self.kind]
        if self.choices:
            words = "one of " + ", ".join(self.choices)
        if self.is_list:
            words = f"a list, each {words}"
        if math.isfinite(self.lower):
            words += f" {'>' if self.lower_open else '>='} {self.lower:g}"
        if math.isfinite(self.upper):
            words += f"{' and' if math.isfinite(self.lower) else ''} <= {self.upper:g}"
        return f"{words} {self.unit}".rstrip()

    def check(self, value: object, prefix: str = "") -> Value:
        """Return ``value`` in the parameter's type, or raise.

        Args:
            value: the value to check.
            prefix: prefix of the name in the message, e.g. ``arm.section_1.``.

        Raises:
            InvalidValueError: the value has the wrong type, is not finite, or is out of range.
        """
        if self.is_list:
            return self.check_list(value, prefix)
        return self._check_item(value, prefix + self.name)

    def check_list(self, value: object, prefix: str = "") -> list[Scalar]:
        """As :meth:`check`, for a list parameter."""
        if isinstance(value, str | bytes) or not isinstance(value, Sequence):
            raise InvalidValueError(prefix + self.name, value, self.allowed)
        return [self._check_item(item, f"{prefix}{self.name}[{i}]") for i, item in enumerate(value)]

    def _check_item(self, value: object, name: str) -> Scalar:
        if self.kind in (int, float):
            return self._check_number(value, name)
        if isinstance(value, str | bool) and isinstance(value, self.kind) and value in (self.choices or (value,)):
            return value
        raise InvalidValueError(name, value, self.allowed)

    def _check_number(self, value: object, name: str) -> int | float:
        if not isinstance(value, int | float) or isinstance(value, bool) or not abs(value) <= sys.float_info.max:
            raise InvalidValueError(name, value, self.allowed)
        too_low = value <= self.lower if self.lower_open else value < self.lower
        if too_low or value > self.upper or (self.kind is int and value != int(value)):
            raise InvalidValueError(name, value, self.allowed)
        return int(value) if self.kind is int else float(value)
