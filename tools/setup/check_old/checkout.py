"""A second checkout, with the same files as this one and with the lock of the old versions."""

from __future__ import annotations

import filecmp
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from tools.setup.layout import LOCK, OLD_LOCK, ROOT

FOLDER = ROOT / "out" / "check_old"

MADE = {".git", ".venv", "build", "install", "log", "out", ".mypy_cache", ".pytest_cache", ".ruff_cache", ".hypothesis"}
"""Folders of a checkout with generated files."""
COMPILED = "__pycache__"


def bring_up_to_date(source: Path = ROOT, target: Path = FOLDER) -> None:
    """Copy changed files and remove deleted ones, so that earlier build results remain usable."""
    wanted = {*_files(source)}
    for gone in {*_files(target)} - wanted:
        (target / gone).unlink()
    for path in wanted:
        given, copy = source / path, target / path
        if not copy.exists() or not filecmp.cmp(given, copy):
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(given, copy)
    shutil.copy2(source / OLD_LOCK.relative_to(ROOT), target / LOCK.relative_to(ROOT))


def _files(root: Path) -> Iterator[Path]:
    """Yield the files of a checkout relative to its root, without generated ones."""
    for folder, names, files in os.walk(root):
        here = Path(folder).relative_to(root)
        names[:] = [name for name in names if name != COMPILED and not (here == Path() and name in MADE)]
        yield from (here / name for name in files)
