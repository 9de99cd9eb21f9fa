"""Convert plain data (from YAML) to the fields of a message."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from ros2_standin.errors import UserError
from ros2_standin.interface_types import message_class

Stamper = Callable[[object], None]
"""Function that writes a time message (``builtin_interfaces/Time``) to a field with ``now`` or ``auto``."""

_ARRAY = re.compile(r"(?P<item>[^\[]+)\[(?P<size>\d+)\]")
_SEQUENCE = re.compile(r"sequence<(?P<item>[^,]+)(,\s*(?P<bound>\d+))?>")
_BITS = re.compile(r"(?P<sign>u?)int(?P<bits>8|16|32|64)")
_FLOATS = ("float", "double", "long double")


def fill_message(message: object, values: object, where: str = "") -> list[Stamper]:
    """Set the fields of ``message`` that ``values`` names.

    A ``std_msgs/Header`` may be ``auto``, a ``builtin_interfaces/Time`` may be ``now``, as with the stock tool: these
    are returned, to be called with the time of each publication.

    Args:
        message: a message; the fields that are not named keep their values.
        values: mapping of field name to value.
        where: name of the message within the whole one, for errors.

    Raises:
        UserError: a field is unknown or a value is not allowed; the message names the field and the allowed values.
    """
    fields: dict[str, str] = message.get_fields_and_field_types()
    if values is None:
        return []
    if not isinstance(values, dict):
        raise _problem(where or "message", values, f"a mapping with some of {', '.join(fields)}")
    stampers: list[Stamper] = []
    for name, value in values.items():
        label = f"{where}.{name}" if where else str(name)
        if name not in fields:
            raise UserError(f"Failed to populate field: there is no field '{label}'; allowed: {', '.join(fields)}")
        kind = fields[name]
        if value == "auto" and kind == "std_msgs/Header":
            stampers.append(partial(setattr, getattr(message, name), "stamp"))
        elif value == "now" and kind == "builtin_interfaces/Time":
            stampers.append(partial(setattr, message, name))
        elif _is_message(kind):
            stampers += fill_message(getattr(message, name), value, label)
        else:
            setattr(message, name, convert(kind, value, label, stampers))
    return stampers


def convert(kind: str, value: object, label: str, stampers: list[Stamper]) -> object:
    """Convert ``value`` for a field of type ``kind`` (in rosidl's notation); raise UserError if this is impossible."""
    if match := _ARRAY.fullmatch(kind):
        size = int(match["size"])
        items = _items(match["item"], value, label, stampers)
        if len(items) != size:
            raise _problem(label, value, f"a list of {size}")
        return items
    if match := _SEQUENCE.fullmatch(kind):
        items = _items(match["item"], value, label, stampers)
        if match["bound"] and len(items) > int(match["bound"]):
            raise _problem(label, value, f"a list of at most {match['bound']}")
        return items
    if _is_message(kind):
        message = message_class(kind)()
        stampers += fill_message(message, value, label)
        return message
    return _basic(kind, value, label)


def _is_message(kind: str) -> bool:
    return "/" in kind and "<" not in kind and "[" not in kind


def _items(kind: str, value: object, label: str, stampers: list[Stamper]) -> list[object]:
    if not isinstance(value, list):
        raise _problem(label, value, "a list")
    return [convert(kind, item, f"{label}[{i}]", stampers) for i, item in enumerate(value)]


def _basic(kind: str, value: object, label: str) -> object:
    if kind == "boolean":
        if not isinstance(value, bool):
            raise _problem(label, value, "true or false")
        return value
    if kind in _FLOATS:
        try:
            return float(value) if not isinstance(value, bool) else _refuse()
        except (TypeError, ValueError, OverflowError):
            raise _problem(label, value, "a number") from None
    if match := _BITS.fullmatch(kind):
        return _whole(value, label, int(match["bits"]), signed=not match["sign"])
    if kind == "octet":
        return bytes([_whole(value, label, 8, signed=False)])
    if kind.startswith(("string", "wstring")):
        if isinstance(value, list | dict) or value is None:
            raise _problem(label, value, "a text")
        return str(value)
    raise UserError(f"Failed to populate field: '{label}' has the type {kind}, which this stand-in does not cover")


def _refuse() -> float:
    raise ValueError


def _whole(value: object, label: str, bits: int, signed: bool) -> int:
    low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if signed else (0, 2**bits - 1)
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise _problem(label, value, f"a whole number from {low} to {high}")
    return value


def _problem(label: str, value: object, allowed: str) -> UserError:
    return UserError(f"Failed to populate field: '{label}' is {value!r}; allowed: {allowed}")
