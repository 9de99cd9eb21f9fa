"""Which version of the analysis, and of the plant, made a result."""

from __future__ import annotations

import hashlib
from pathlib import Path

import blind.plant

import continuum

_PARTS = ("discovery", "identification", "effects", "dynamics")
_KINDS = (".py", ".yaml")


def digest_of_sources() -> str:
    """Of all files that a verdict may depend on, 12 hexadecimal digits."""
    library = Path(str(continuum.__file__)).parent
    return digest([*(library / part for part in _PARTS), Path(str(blind.plant.__file__)).parent])


def digest(folders: list[Path]) -> str:
    """Of names and contents of the sources in some folders."""
    total = hashlib.sha256()
    for folder in folders:
        for path in sorted(path for path in folder.rglob("*") if path.suffix in _KINDS):
            total.update(f"{folder.name}/{path.relative_to(folder)}\n".encode())
            total.update(path.read_bytes())
    return total.hexdigest()[:12]
