"""Message and service classes of installed packages, found by the name of their type."""

from __future__ import annotations

import importlib

from ros2_standin.errors import UserError


def message_class(type_name: str) -> type:
    """Class of ``package/msg/Name`` (``package/Name`` will do)."""
    return _interface(type_name, "msg")


def service_class(type_name: str) -> type:
    """Class of ``package/srv/Name`` (``package/Name`` will do)."""
    return _interface(type_name, "srv")


def _interface(type_name: str, kind: str) -> type:
    parts = type_name.split("/")
    if len(parts) == 2:
        parts.insert(1, kind)
    if len(parts) != 3 or parts[1] != kind or not all(part.isidentifier() for part in parts):
        raise UserError(f"The passed {kind} type '{type_name}' is invalid; allowed: package/{kind}/Name")
    try:
        module = importlib.import_module(f"{parts[0]}.{kind}")
        found = getattr(module, parts[2])
        support = found.__class__.__import_type_support__
    except (ImportError, AttributeError) as error:
        raise UserError(f"The passed {kind} type '{type_name}' is not installed, or its package not sourced") from error
    try:
        support()
    except (ImportError, RuntimeError) as error:
        raise UserError(f"The type support of '{type_name}' cannot be loaded: {error}") from error
    return found
