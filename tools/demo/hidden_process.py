"""The search for the hidden effect as a separate process, at low priority while the nodes run."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[2]


def search_log(out: Path) -> Path:
    """Return the log file of the search."""
    return out / "hidden_effect.log"


@contextmanager
def finding_hidden_effect(seed: int, out: Path) -> Iterator[subprocess.Popen[bytes]]:
    """Run the search during the block; it is stopped at the end in any case."""
    paths = [str(_ROOT), str(_ROOT / "test"), os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, paths))}
    command = ["nice", sys.executable, "-m", "tools.demo.hidden_effect", "--seed", str(seed), "--out", str(out)]
    with search_log(out).open("wb") as log:
        search = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, env=environment)
        try:
            yield search
        finally:
            search.kill()
            search.wait()
