"""Files that come with the library, arms and models: a command takes their names in place of a path."""

from __future__ import annotations

from pathlib import Path

from continuum.did_you_mean import did_you_mean
from continuum.errors import FileError

ARMS = Path(__file__).parent / "arms"
"""Parameter files of arms; `continuum_description/config` has links to them."""

MODELS = Path(__file__).parent / "dynamics" / "models"
"""Model files of planar arms."""

_FOLDERS = (ARMS, MODELS)


def shipped_names(folder: Path) -> list[str]:
    """Names of the files in one of the two folders."""
    return sorted(path.name for path in folder.glob("*.yaml"))


def find_file(name: str | Path, folder: Path) -> Path:
    """``name`` itself where it is there, else the shipped file of that name; one of the other kind is found too.

    A path that leads to nothing is returned as it is: whoever reads it says why it cannot be read.

    Args:
        name: a path, or the name of a shipped file, with or without its suffix.
        folder: ARMS or MODELS, whichever is meant.

    Raises:
        FileError: a name without a folder that no file has, neither here nor in the library.
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
    """The file in the folder."""
    if not str(name) or Path(name).name != str(name):
        return None
    return next((path for end in ("", ".yaml") if (path := folder / f"{name}{end}").is_file()), None)
