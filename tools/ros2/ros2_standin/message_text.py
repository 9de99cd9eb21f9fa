"""Messages as text: YAML, as ``ros2 topic echo`` prints it, and CSV."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import yaml

from ros2_standin.errors import UserError

_NEVER_FOLDED = 2**31 - 1
_Dumper = getattr(yaml, "CSafeDumper", yaml.SafeDumper)


@dataclass(frozen=True)
class Shortening:
    """Shortening of a message's text.

    Attributes:
        longest: lists and texts are truncated after this many items; None never truncates.
        no_arrays, no_strings: whether only the type and length of lists, or texts, are printed.
    """

    longest: int | None = None
    no_arrays: bool = False
    no_strings: bool = False


def plain(value: object, short: Shortening = Shortening()) -> object:
    """A message, or a field of one, as mappings, lists and plain values."""
    if hasattr(value, "get_fields_and_field_types"):
        fields: dict[str, str] = value.get_fields_and_field_types()
        return {name: _field(getattr(value, name), kind, short) for name, kind in fields.items()}
    return _field(value, "", short)


def _field(value: object, kind: str, short: Shortening) -> object:
    if hasattr(value, "get_fields_and_field_types"):
        return plain(value, short)
    if isinstance(value, bytes):
        value = value.decode("latin-1")
    if isinstance(value, str):
        if short.no_strings:
            return f"<string length: <{len(value)}>>"
        return value if short.longest is None or len(value) <= short.longest else value[: short.longest] + "..."
    if isinstance(value, bool | int | float):
        return value
    items = value.tolist() if hasattr(value, "tolist") else list(value)
    if short.no_arrays:
        return f"<{_array_name(kind)}, length: {len(items)}>"
    cut = short.longest is not None and len(items) > short.longest
    return [_field(item, "", short) for item in items[: short.longest]] + (["..."] if cut else [])


def _array_name(kind: str) -> str:
    return f"sequence type: {kind[9:-1]}" if kind.startswith("sequence<") else f"array type: {kind}"


def yaml_text(value: object, flow: bool = False) -> str:
    """Plain data as YAML, ending in a newline, no line ever folded."""
    text = yaml.dump(
        value, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=_NEVER_FOLDED, default_flow_style=flow
    )
    return text.removesuffix("...\n")


def csv_text(value: object) -> str:
    """Return plain data as one line: all values in order, separated by commas."""
    return ",".join(_leaves(value))


def _leaves(value: object) -> Iterator[str]:
    if isinstance(value, dict):
        for item in value.values():
            yield from _leaves(item)
    elif isinstance(value, list):
        for item in value:
            yield from _leaves(item)
    else:
        yield str(value)


def pick(message: object, path: Sequence[str]) -> object:
    """Return the part of a message with a dotted name (already split).

    Raises:
        UserError: the field does not exist.
    """
    for i, name in enumerate(path):
        if not hasattr(message, "get_fields_and_field_types") or name not in message.get_fields_and_field_types():
            raise UserError(
                f"Invalid field '{'.'.join(path)}': there is no '{name}' in {'.'.join(path[:i]) or 'the message'}"
            )
        message = getattr(message, name)
    return message
