"""Cases on disk: the data where the analysis looks, the truth elsewhere."""

import json
import os
from pathlib import Path

from blind.mujoco_plant.case import Case

STAMP = 1_690_000_000  # every file's time, whatever it holds and whenever it was written [s]


def write_case(case: Case, folder: Path, sealed: Path | None = None) -> list[Path]:
    """Write a case's files, all with the same time, and the truth if wanted.

    Args:
        case: what to write.
        folder: for the data; made if need be.
        sealed: file for the truth, outside of ``folder``.

    Returns:
        The data files, in the order of their names.

    Raises:
        ValueError: the truth would lie in the data's folder.
    """
    if sealed is not None and sealed.resolve().is_relative_to(folder.resolve()):
        raise ValueError(f"{sealed} lies in {folder}, where the analysis looks")
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for name in sorted(case.files):
        paths.append(folder / name)
        paths[-1].write_bytes(case.files[name])
        os.utime(paths[-1], (STAMP, STAMP))
    os.utime(folder, (STAMP, STAMP))
    if sealed is not None:
        sealed.parent.mkdir(parents=True, exist_ok=True)
        sealed.write_text(json.dumps(case.truth.plain(), indent=1) + "\n", encoding="utf-8")
    return paths
