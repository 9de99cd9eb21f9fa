"""The folder for results: one demo at a time, and nothing left in it of the one before."""

from __future__ import annotations

import fcntl
import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from tools.demo.errors import DemoError

RESULTS = ("recording", "nodes.log", "viewer.log", "cable_states.csv", "cables.png")


@contextmanager
def claimed(folder: Path, results: Sequence[str] = RESULTS) -> Iterator[None]:
    """Make ``folder`` and remove the ``results`` of an earlier demo from it; no other demo writes there meanwhile.

    Raises:
        DemoError: another demo does, or the folder cannot be made.
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
        for name in results:
            path = folder / name
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink(missing_ok=True)
        yield
    finally:
        os.close(handle)
