"""Read ROS 2 parameter files without ROS, so that the files for ``--params-file`` also serve the library."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from continuum.errors import FileError, InvalidValueError


class _Loader(yaml.SafeLoader):
    """PyYAML's safe loader, limited to numbers that all YAML versions agree on, plus ``1e-2`` as in ROS.

    ``010``, ``1:30`` and ``1_0`` are 8, 90 and 10 in YAML 1.1, but other numbers or text elsewhere; here they are text.
    Aliases are refused, because a few lines of them can expand to more values than memory holds. Duplicate keys are
    refused, because one of their values would be lost.
    """

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Compose the next node; refuse an alias."""
        if self.check_event(yaml.AliasEvent):
            raise yaml.YAMLError(f"line {self.line + 1}: aliases are not allowed; write the values out")
        return super().compose_node(parent, index)

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        """Construct a mapping; refuse keys that are not names, and duplicate keys."""
        seen = set[str]()
        for key, _ in node.value:
            if not isinstance(key.value, str):
                raise yaml.YAMLError(f"line {key.start_mark.line + 1}: a key that is not a name")
            if key.value in seen:
                raise yaml.YAMLError(f"line {key.start_mark.line + 1}: the key {key.value!r} occurs twice")
            seen.add(key.value)
        return super().construct_mapping(node, deep)


_NUMBERS = {
    "tag:yaml.org,2002:int": re.compile(r"([-+]?(0|[1-9]\d*)|0x[0-9a-fA-F]+)$", re.ASCII),
    "tag:yaml.org,2002:float": re.compile(
        r"([-+]?(\d+\.\d*|\.\d+|\d+(?=[eE]))([eE][-+]?\d+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN))$", re.ASCII
    ),
}
_Loader.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in resolvers if tag not in _NUMBERS]
    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
for _tag, _pattern in _NUMBERS.items():
    _Loader.add_implicit_resolver(_tag, _pattern, list("-+.0123456789"))


def read_parameter_file(path: str | Path) -> Mapping[str, object]:
    """Return the nested parameters of a YAML file: those under ``/**: ros__parameters:``, or all without that key.

    Raises:
        FileError: the file cannot be read, or does not contain a mapping.
    """
    try:
        block = yaml.load(Path(path).read_bytes(), Loader=_Loader)  # noqa: S506  (a safe loader)
    except OSError as error:
        raise FileError(path, f"cannot be read ({error})") from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:  # ValueError: an impossible date
        raise FileError(path, f"is not valid YAML ({' '.join(str(error).split())})") from error
    for key in ("/**", "ros__parameters"):
        if isinstance(block, Mapping) and key in block:
            block = block[key]
    if not isinstance(block, Mapping):
        raise FileError(path, f"contains {block!r:.60} instead of parameters: names and their values in YAML")
    try:
        flat = flattened(block)
    except RecursionError as error:
        raise FileError(path, "is a mapping that contains itself") from error
    except InvalidValueError as error:
        raise FileError(path, str(error)) from error
    for name, value in flat.items():
        if isinstance(value, list) and {int, float} <= {type(item) for item in value}:
            raise FileError(path, f"{name} is {value}: ROS does not allow integers among decimals; write 0.0, not 0")
    return block


def flattened(block: Mapping[str, object], prefix: str = "") -> dict[str, object]:
    """Return parameters by dotted ROS names: ``{"helix": {"radius": 0.15}}`` gives ``{"helix.radius": 0.15}``."""
    flat: dict[str, object] = {}
    for key, value in block.items():
        more = flattened(value, f"{prefix}{key}.") if isinstance(value, Mapping) else {f"{prefix}{key}": value}
        if twice := flat.keys() & more.keys():
            raise InvalidValueError(min(twice), more[min(twice)], "a single value; the name occurs twice")
        flat |= more
    return flat
