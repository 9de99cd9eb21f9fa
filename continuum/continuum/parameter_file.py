"""ROS 2 parameter files, read without ROS: the files that nodes get by ``--params-file`` serve the library too."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from continuum.errors import FileError, InvalidValueError


class _Loader(yaml.SafeLoader):
    """PyYAML's safe loader, which takes for numbers what every YAML does, and ``1e-2`` as ROS; aliases are refused.

    ``010``, ``1:30`` and ``1_0`` are 8, 90 and 10 in YAML 1.1, another number or text elsewhere: they stay text. A few
    lines of aliases can stand for more values than memory holds. A key that stands twice is refused too: one of its
    values would be lost.
    """

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """The next node, no alias."""
        if self.check_event(yaml.AliasEvent):
            raise yaml.YAMLError(f"line {self.line + 1}: an alias; write its values out")
        return super().compose_node(parent, index)

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        """A mapping, each of whose keys stands once."""
        seen = set[str]()
        for key, _ in node.value:
            if not isinstance(key.value, str):
                raise yaml.YAMLError(f"line {key.start_mark.line + 1}: a key that is no name")
            if key.value in seen:
                raise yaml.YAMLError(f"line {key.start_mark.line + 1}: the key {key.value!r} stands twice")
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
    """The parameters of a YAML file, nested: what stands under ``/**: ros__parameters:``, or all of it without that.

    Raises:
        FileError: the file cannot be read, or holds no mapping.
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
        raise FileError(path, f"holds no parameters, but {block!r:.60}; names and their values in YAML are needed")
    try:
        flat = flattened(block)
    except RecursionError as error:
        raise FileError(path, "is a mapping that holds itself") from error
    except InvalidValueError as error:
        raise FileError(path, str(error)) from error
    for name, value in flat.items():
        if isinstance(value, list) and {int, float} <= {type(item) for item in value}:
            raise FileError(path, f"{name} is {value}: ROS takes no whole numbers among decimals; write 0.0, not 0")
    return block


def flattened(block: Mapping[str, object], prefix: str = "") -> dict[str, object]:
    """Nested parameters by their dotted ROS names: ``{"helix": {"radius": 0.15}}`` gives ``{"helix.radius": 0.15}``."""
    flat: dict[str, object] = {}
    for key, value in block.items():
        more = flattened(value, f"{prefix}{key}.") if isinstance(value, Mapping) else {f"{prefix}{key}": value}
        if twice := flat.keys() & more.keys():
            raise InvalidValueError(min(twice), more[min(twice)], "once; it stands twice")
        flat |= more
    return flat
