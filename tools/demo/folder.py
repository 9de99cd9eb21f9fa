"""The folder for results: used by one demo at a time; earlier results are kept until there are new ones."""

from __future__ import annotations

import fcntl
import os
import shutil
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from tools.demo.errors import DemoError

RESULTS = (
    *("recording", "nodes.log", "viewer.log", "cable_states.csv", "cables.png"),
    *("hidden_effect", "hidden_effect.html", "hidden_effect.png", "hidden_effect.yaml", "hidden_effect.log"),
)

PREVIOUS = "previous"
"""Subfolder for the results of an earlier demo until there are new ones."""


@contextmanager
def claimed(folder: Path, results: Sequence[str] = RESULTS) -> Iterator[None]:
    """Create ``folder``, lock it against other demos, and move the ``results`` of an earlier demo aside.

    The earlier results are removed at the end of the block, unless it ends with an error or an interrupt.

    Raises:
        DemoError: another demo writes to the folder, or it cannot be created.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError as error:
        raise DemoError(f"{folder} cannot be made ({error.strerror})") from error
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise DemoError(f"another demo is writing to {folder}; wait for its end, or give --out") from None
        aside, whole = _put_aside(folder, results), False
        try:
            yield
            whole = True
        finally:
            if whole:
                shutil.rmtree(aside, ignore_errors=True)
            elif aside.exists():
                print(f"the results of the previous demo are in {aside}", file=sys.stderr)
    finally:
        os.close(handle)


def _put_aside(folder: Path, results: Sequence[str]) -> Path:
    """Move results aside and return their folder; if it holds a complete demo, remove those of an interrupted one."""
    aside = folder / PREVIOUS
    keep = not aside.exists()
    for path in (folder / name for name in results):
        if keep and path.exists():
            aside.mkdir(exist_ok=True)
            path.rename(aside / path.name)
        elif path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)
    return aside
