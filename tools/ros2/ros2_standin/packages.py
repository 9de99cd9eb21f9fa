"""Installed packages and their executables, looked up along AMENT_PREFIX_PATH."""

from __future__ import annotations

import os
from pathlib import Path

from ros2_standin.errors import UserError

_MARKERS = Path("share/ament_index/resource_index/packages")


def prefixes() -> list[Path]:
    """The folders of AMENT_PREFIX_PATH, first one first."""
    return [Path(part) for part in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if part]


def package_names() -> dict[str, Path]:
    """Every package with its prefix; an earlier prefix overlays a later one."""
    found: dict[str, Path] = {}
    for prefix in prefixes():
        folder = prefix / _MARKERS
        if folder.is_dir():
            for marker in sorted(folder.iterdir()):
                found.setdefault(marker.name, prefix)
    return found


def package_prefix(package: str) -> Path:
    """Prefix of a package.

    Raises:
        UserError: no such package.
    """
    plain = package and "/" not in package and package not in (".", "..")
    for prefix in prefixes() if plain else []:
        if (prefix / _MARKERS / package).is_file():
            return prefix
    hint = "" if prefixes() else " (AMENT_PREFIX_PATH is empty: source install/setup.bash first)"
    raise UserError(f"Package '{package}' not found{hint}")


def package_share(package: str) -> Path:
    """Share folder of a package."""
    return package_prefix(package) / "share" / package


def package_executables(package: str) -> list[Path]:
    """Executables of a package, those below lib/<package>."""
    folder = package_prefix(package) / "lib" / package
    found = folder.rglob("*") if folder.is_dir() else []
    return sorted(path for path in found if path.is_file() and os.access(path, os.X_OK))


def package_executable(package: str, executable: str) -> Path:
    """One executable of a package.

    Raises:
        UserError: no such package, none or several such executables.
    """
    found = [path for path in package_executables(package) if path.name == executable]
    if not found:
        names = ", ".join(path.name for path in package_executables(package)) or "none"
        raise UserError(f"No executable found: package '{package}' has no '{executable}' (it has: {names})")
    if len(found) > 1:
        raise UserError(f"Multiple executables found for '{executable}': {', '.join(map(str, found))}")
    return found[0]
