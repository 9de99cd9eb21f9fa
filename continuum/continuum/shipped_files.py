"""Arm and model files in the library, which commands accept by name instead of a path."""

from __future__ import annotations

from pathlib import Path

from continuum.did_you_mean import did_you_mean
from continuum.errors import FileError

ARMS = Path(__file__).parent / "arms"
"""Folder of the arms' parameter files; `continuum_description/config` contains links to them."""

MODELS = Path(__file__).parent / "dynamics" / "models"
"""Folder of the model files of planar arms."""

_FOLDERS = (ARMS, MODELS)


def shipped_names(folder: Path) -> list[str]:
    """Return the names of the files in one of the two folders."""
    return sorted(path.name for path in folder.glob("*.yaml"))


def find_file(name: str | Path, folder: Path) -> Path:
    """Return ``name`` if that path exists, otherwise the library's file of that name, which may be of the other kind.

    A path with a folder that does not exist is returned unchanged, so that its reader reports the error.

    Args:
        name: a path, or the name of a file in the library, with or without its suffix.
        folder: ARMS or MODELS, the folder that is searched first.

    Raises:
        FileError: no file has this name without a folder, neither in the current folder nor in the library.
    """
    path = Path(name)
    if path.exists():
        return path
    for one in (folder, *_FOLDERS):
        if (found := _shipped(name, one)) is not None:
            return found
    if path.name != str(name):
        return path
    known = shipped_names(folder)
    near = did_you_mean(path.stem, [Path(one).stem for one in known])
    raise FileError(name, f"cannot be read (no such file); the library has {', '.join(known)}{near}")


def _shipped(name: str | Path, folder: Path) -> Path | None:
    """Return the file of that name in the folder, or None."""
    if not str(name) or Path(name).name != str(name):
        return None
    return next((path for end in ("", ".yaml") if (path := folder / f"{name}{end}").is_file()), None)
