"""The picture of the front page: the result of the demo's search."""

from __future__ import annotations

import tempfile
from pathlib import Path

from continuum.whole_file import write_whole
from tools.demo.command import SEED
from tools.demo.hidden_effect import find_hidden_effect
from tools.docs.small_png import shrink


def draw_hidden_effect(path: Path) -> None:
    """Find the demo's effect, and write its picture."""
    with tempfile.TemporaryDirectory() as folder:
        find_hidden_effect(SEED, Path(folder))
        write_whole(path, (Path(folder) / "hidden_effect.png").read_bytes())
    shrink(path)
