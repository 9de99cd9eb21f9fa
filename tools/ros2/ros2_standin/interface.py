"""``ros2 interface list|package|show``: definitions of messages, services and actions of installed packages."""

from __future__ import annotations

import argparse
import re
from pathlib import Path

from ros2_standin.errors import UserError
from ros2_standin.packages import package_names, package_share

_KINDS = {"msg": "Messages", "srv": "Services", "action": "Actions"}
_FIELD = re.compile(r"^\s*([A-Za-z]\w*(?:/[A-Za-z]\w*)?)(?:\[[^\]]*\])?\s+[A-Za-z]\w*\s*(?:#.*)?$")
"""A field without a constant's value: its type, and its name."""


def interfaces(package: str) -> list[str]:
    """Names of a package's interfaces, ``package/kind/Name``, by kind."""
    share = package_share(package)
    return [f"{package}/{kind}/{path.stem}" for kind in _KINDS for path in sorted((share / kind).glob(f"*.{kind}"))]


def definition(name: str) -> str:
    """Text of ``package/kind/Name`` (``package/Name`` is a message).

    Raises:
        UserError: there is no such interface.
    """
    return _file(name).read_text()


def _file(name: str) -> Path:
    parts = name.split("/")
    if len(parts) == 2:
        parts.insert(1, "msg")
    if len(parts) != 3 or parts[1] not in _KINDS or not parts[2].isidentifier():
        raise UserError(f"Invalid interface name '{name}'; allowed: package/{{{','.join(_KINDS)}}}/Name")
    package, kind, last = parts
    path = package_share(package) / kind / f"{last}.{kind}"
    if not path.is_file():
        raise UserError(f"Unknown interface '{name}'; `ros2 interface package {package}` lists what there is")
    return path


def expanded(name: str, comments: bool = True, depth: int = 0) -> list[str]:
    """Lines of a definition; below each field of a message's type, that message's lines, indented by a tab."""
    lines = []
    package = name.split("/")[0]
    for line in definition(name).splitlines():
        if not comments and depth == 0:
            line = line.split("#")[0].rstrip()
        if not line.strip() or (depth and line.lstrip().startswith("#")):
            if depth == 0 and (comments or line):
                lines.append(line)
            continue
        lines.append("\t" * depth + (line.split("#")[0].rstrip() if depth else line))
        field = _FIELD.match(line)
        nested = field and _message(field[1], package)
        if nested:
            lines += expanded(nested, comments, depth + 1)
    return lines


def _message(field_type: str, package: str) -> str | None:
    """Message that a field's type names; None for a type of the language."""
    if "/" in field_type:
        return field_type
    return f"{package}/{field_type}" if (package_share(package) / "msg" / f"{field_type}.msg").is_file() else None


def show_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``show``."""
    parser.add_argument("type", help="Show an interface definition (e.g. 'example_interfaces/msg/String')")
    parser.add_argument("--no-comments", action="store_true", help="Show no comments and no empty lines")


def show_verb(args: argparse.Namespace) -> None:
    """Print a definition with those of its fields."""
    print("\n".join(expanded(args.type, not args.no_comments)))


def package_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``package``."""
    parser.add_argument("package_name", help="Name of the package (e.g. 'example_interfaces')")


def package_verb(args: argparse.Namespace) -> None:
    """Print the names of a package's interfaces."""
    for name in interfaces(args.package_name):
        print(name)


def list_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``list``."""
    for kind, title in _KINDS.items():
        parser.add_argument(
            f"--only-{kind}s", f"-{kind[0]}", action="store_true", help=f"Print out only {title.lower()}"
        )


def list_verb(args: argparse.Namespace) -> None:
    """Print the names of all installed interfaces, by kind."""
    chosen = [kind for kind in _KINDS if getattr(args, f"only_{kind}s")] or list(_KINDS)
    names = [name for package in package_names() for name in interfaces(package)]
    for kind in chosen:
        print(f"{_KINDS[kind]}:")
        for name in sorted(name for name in names if name.split("/")[1] == kind):
            print(f"    {name}")
