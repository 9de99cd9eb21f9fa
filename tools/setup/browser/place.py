"""Places of the browser and of its driver."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[3] / "out" / "browser"
EXTRA = FOLDER / "extra"
"""Python packages: Playwright."""

ROOT = FOLDER / "root"
"""Debian packages, unpacked."""


@dataclass(frozen=True)
class Chromium:
    """A Chromium program.

    Attributes:
        path: path of the program.
        libraries: folders of shared libraries that it needs and the machine may lack.
    """

    path: Path
    libraries: tuple[Path, ...] = ()


def chromium() -> Chromium | None:
    """Return the machine's Chromium, or the fetched one; None if there is neither."""
    for name in ("chromium", "chromium-browser", "google-chrome"):
        found = shutil.which(name)
        if found:
            return Chromium(Path(found))
    program = ROOT / "usr" / "lib" / "chromium" / "chromium"
    if not program.is_file():
        return None
    return Chromium(program, tuple(sorted({path.parent for path in ROOT.glob("**/*.so*")})))


def environment(program: Chromium) -> dict[str, str]:
    """Return the environment in which the program finds its libraries."""
    libraries = os.pathsep.join(map(str, program.libraries))
    return dict(os.environ) | ({"LD_LIBRARY_PATH": libraries} if libraries else {})
