"""Content hashes of the inputs of the present .venv, build and install, in one small file."""

import hashlib
import json
import sys
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path

from tools.setup.layout import BUILD, INSTALL, LOCK, PYTHON, ROOT, SETUP, STAMP, package_folders

READ_BY_BUILD = ("MANIFEST.in", "package.xml", "pyproject.toml", "setup.cfg", "setup.py")


@dataclass
class Stamp:
    """Hashes of the inputs: ``environment`` of .venv, ``packages`` of each package, ``compiled`` of the solver."""

    environment: str = ""
    packages: dict[str, str] = field(default_factory=dict)
    compiled: str = ""

    def write(self) -> None:
        BUILD.mkdir(exist_ok=True)
        STAMP.write_text(json.dumps(asdict(self), indent=1), encoding="utf-8")


def made() -> Stamp:
    """Return the stamp of the present build, empty if there is nothing usable."""
    try:
        stamp = Stamp(**json.loads(STAMP.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return Stamp()
    if not PYTHON.exists():
        return Stamp()
    if not (INSTALL / "setup.bash").exists():
        stamp.packages = {}
    stamp.packages = {name: value for name, value in stamp.packages.items() if _is_installed(name)}
    return stamp


def wanted() -> Stamp:
    """Return the stamp that the checkout requires."""
    environment = _digest([str(ROOT), sys.base_prefix, sys.version, LOCK.read_bytes()])
    built_by = [environment, *(path.read_bytes() for path in sorted(SETUP.glob("*.cmake")))]
    packages = {p.name: _digest([*built_by, *_inputs(p)]) for p in package_folders()}
    return Stamp(environment, packages, _digest([environment, *(path.read_bytes() for path in _compiled_sources())]))


def _compiled_sources() -> list[Path]:
    """Return the sources of numba's cached code."""
    library = ROOT / "continuum" / "continuum"
    folders = ("kinematics", "dynamics/integration", "dynamics/spatial", "estimation", "discovery")
    return sorted(path for folder in folders for path in (library / folder).rglob("*.py"))


def _is_installed(name: str) -> bool:
    return (INSTALL / name / "share" / name / "package.xml").exists()


def _inputs(package: Path) -> Iterator[str | bytes]:
    """Yield the inputs of a build of ``package``.

    The files of Python packages are linked, not copied, into install/, so only their names matter; all of a CMake
    package is compiled.
    """
    is_python = (package / "setup.py").exists()
    for path in sorted(package.rglob("*")):
        relative = path.relative_to(package)
        in_code = is_python and relative.parts[0] == package.name and not _names_matter(relative)
        if in_code or relative.parts[0] == "test" or "__pycache__" in relative.parts or not path.is_file():
            continue
        yield str(relative)
        if not is_python or relative.name in READ_BY_BUILD:
            yield path.read_bytes()


def _names_matter(relative: Path) -> bool:
    """Return whether a build depends on the names of such files: __init__.py for packages, and files of effects."""
    return relative.name == "__init__.py" or relative.parts[1:-1] == ("effects",)


def _digest(parts: Iterable[str | bytes]) -> str:
    digest = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        digest.update(len(data).to_bytes(8) + data)
    return digest.hexdigest()
