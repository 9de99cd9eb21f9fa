"""A copy of the checkout in which tests run, so that files in use elsewhere are never edited.

Source files keep their times, so that compiled code of numba and Python is reused; a file with a fault has another time
and another digest, and so has the code compiled from it. Environment and build are those of the checkout.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from continuum.whole_file import write_whole
from tools.benchmarks.seeded_faults.table import Fault

_LINKED = (".venv", "build", "install")
_LEFT_OUT = shutil.ignore_patterns(*_LINKED, ".git", "log", "out", ".*_cache", ".hypothesis")
_LONGEST = 900.0
"""Time after which a test run counts as hanging [s]."""


class CopyOfCheckout:
    """The copy of ``root`` in ``place``, which must not exist yet."""

    def __init__(self, root: Path, place: Path) -> None:
        self._root, self._place = root, place
        shutil.copytree(root, place, ignore=_LEFT_OUT)
        for name in filter(lambda name: (root / name).exists(), _LINKED):
            (place / name).symlink_to(root / name)

    def failures_with(self, fault: Fault, tests: Sequence[str]) -> list[str]:
        """Run tests with the fault until the first failure and return its id; the file is restored afterwards."""
        file = self._place / fault.path
        write_whole(file, file.read_text(encoding="utf-8").replace(fault.text, fault.instead))
        try:
            return self.failures(tests, "--exitfirst")
        finally:
            shutil.copy2(self._root / fault.path, file)

    def failures(self, tests: Sequence[str], *options: str) -> list[str]:
        """Return the ids of failing tests; if they hang or pytest fails, the files."""
        paths = os.environ.get("PYTHONPATH", "").split(os.pathsep)
        copied = [path.replace(f"{self._root}/build/", f"{self._place}/") for path in paths]
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join([*copied, *paths]),
            "PYTHONDONTWRITEBYTECODE": "1",  # byte code of a file with equal time and size would replace the faulty one
        }
        cache = self._place / ".pytest_cache"
        shutil.rmtree(cache, ignore_errors=True)
        command = [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "--hypothesis-seed=0",
            f"-ocache_dir={cache}",
            *options,
            *tests,
        ]
        with subprocess.Popen(
            command, cwd=self._place, env=environment, start_new_session=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        ) as process:  # fmt: skip
            try:
                process.wait(_LONGEST)
            except subprocess.TimeoutExpired:
                return list(tests)
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
        failed = cache / "v" / "cache" / "lastfailed"
        if not process.returncode:
            return []
        return list(json.loads(failed.read_text(encoding="utf-8"))) if failed.exists() else list(tests)
