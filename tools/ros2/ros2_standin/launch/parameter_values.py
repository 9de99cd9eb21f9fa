"""Values of ``param`` tags with their types, and the parameter files that carry them to nodes."""

from __future__ import annotations

import tempfile
from pathlib import Path
from types import MappingProxyType

import yaml

from ros2_standin.launch.scope import Scope
from ros2_standin.launch.substitution import expand
from ros2_standin.launch.xml_tree import Element

_SCALARS: MappingProxyType[str, type] = MappingProxyType({"str": str, "int": int, "float": float, "bool": bool})
_TYPES = (*_SCALARS, "yaml", *(f"list_of_{name}" for name in _SCALARS))


def parameter_tree(params: list[Element], scope: Scope) -> dict[str, object]:
    """Names and values of ``param`` tags with ``name``; nested tags give nested mappings.

    Raises:
        UserError: a value that no parameter can have.
    """
    tree: dict[str, object] = {}
    for param in params:
        param.check(("name", "value", "type", "value-sep"), ("param",))
        name = expand(param.required("name"), scope)
        if param.children and "value" in param.attributes:
            raise param.error("has both a value and param tags within it")
        tree[name] = parameter_tree(param.children, scope) if param.children else _value(param, scope)
    return tree


def _value(param: Element, scope: Scope) -> object:
    text = expand(param.required("value"), scope)
    kind = param.attributes.get("type", "yaml")
    if kind not in _TYPES:
        raise param.error(f"has the type {kind!r}; allowed: {', '.join(_TYPES)}")
    separator = param.attributes.get("value-sep")
    if separator is not None:
        return [typed(item, kind.removeprefix("list_of_"), param) for item in text.split(separator)]
    return typed(text, kind, param)


def typed(text: str, kind: str, param: Element) -> object:
    """``text`` as ROS reads a parameter: ``yaml`` guesses the type, any other ``kind`` demands it.

    Raises:
        UserError: it is not of that type, or no parameter can have it (a mapping, a list of mixed types).
    """
    if kind == "str":
        return text
    try:
        value = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise param.error(f'has the value {text!r}, which is not YAML; type="str" takes it as it is') from error
    if value is None:
        value = text
    if kind == "float" and type(value) is int:
        value = float(value)
    items = value if isinstance(value, list) else [value]
    types = {type(item) for item in items}
    wanted = None if kind == "yaml" else _SCALARS[kind.removeprefix("list_of_")]
    good = len(types) <= 1 and types <= set(_SCALARS.values()) and (wanted is None or types <= {wanted})
    if not good or (kind != "yaml" and kind.startswith("list_of_") != isinstance(value, list)):
        allowed = "one truth value, number or text, or a list of such of one type" if kind == "yaml" else f"a {kind}"
        raise param.error(f"has the value {text!r}; allowed: {allowed}")
    return value


class ParameterFiles:
    """Temporary parameter files, gone when the block ends."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="launch_params_")
        self._count = 0

    def __enter__(self) -> ParameterFiles:
        return self

    def __exit__(self, *_exception: object) -> None:
        self._folder.cleanup()

    def write(self, parameters: dict[str, object], node: str = "/**") -> Path:
        """A file with the parameters of ``node`` (full name, or a pattern)."""
        return self.write_text(yaml.safe_dump({node: {"ros__parameters": parameters}}, sort_keys=False))

    def write_text(self, text: str) -> Path:
        """A file with this text."""
        self._count += 1
        path = Path(self._folder.name) / f"{self._count}.yaml"
        path.write_text(text)
        return path
