"""`make figures`, after `make reproduction` and `make prototype`: the arm on the helix, and its cables.

Overwrites pictures, which are under version control, unless `--out` names another folder.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from continuum.recordings.arm_recording import ArmRecording
from continuum.recordings.cable_figure import write_cable_figure
from tools.docs.figures.arm_on_helix import draw_arm
from tools.docs.figures.helix_run import helix_run
from tools.docs.figures.hidden_effect import draw_hidden_effect
from tools.docs.figures.three_sections import draw_three_sections
from tools.docs.small_png import shrink
from tools.one_line import in_one_line

type Draw = Callable[[ArmRecording, Path], None]

PICTURES: dict[str, Draw] = {"helix.png": draw_arm, "cables.png": write_cable_figure}
"""Functions that draw each picture from the run."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--out", type=Path, default=Path("docs"), help="folder whose pictures/ is written; default %(default)s"
    )
    folder: Path = parser.parse_args().out / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    run = helix_run()
    for name, draw in PICTURES.items():
        draw(run, folder / name)
        shrink(folder / name)
        print(f"written: {folder / name}")
    others = {"hidden_effect.png": draw_hidden_effect, "three_sections.png": draw_three_sections}
    for name, draw_other in others.items():
        draw_other(folder / name)
        print(f"written: {folder / name}")


if __name__ == "__main__":
    sys.exit(in_one_line(main))
