"""Repeat the diagnosis in other processes, with slightly different readings and other kernels of linear algebra."""

from __future__ import annotations

import ctypes
import json
import os
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from continuum.discovery import Diagnosis, diagnose
from continuum.dynamics.model_file import load_model
from continuum.recordings.recording_csv import read_recording_csv

RELATIVE, READING = 1e-9, 0.03  # of an angle: a rounding; and about what the plot of this run was read with [deg]
ROUNDING = [("", RELATIVE, 0.0, seed) for seed in (1, 2, 3)]
ROUNDING += [(kernel, 0.0, 0.0, 0) for kernel in ("HASWELL", "SANDYBRIDGE", "PRESCOTT")]
NOISE = [("", 0.0, READING, seed) for seed in (1, 2, 3, 4, 5)]
"""Kernel of OpenBLAS, noise relative and in degrees, and its seed."""


@dataclass(frozen=True)
class Said:
    """A diagnosis in short: kernel of OpenBLAS, kind of verdict, sets of effects with joints, closed share, 0 to 1."""

    kernel: str
    kind: str
    effects: list[str]
    closed: float


def said(result: Diagnosis) -> Said:
    sets = [" + ".join(sorted(cause.label for cause in causes)) for causes in result.sets if causes]
    return Said(kernel(), result.verdict.kind.value, sets, result.closed.value)


def kernel() -> str:
    """Return OpenBLAS's name of the kernel that NumPy uses; empty if it is unknown."""
    for library in (Path(np.__file__).parents[1] / "numpy.libs").glob("libscipy_openblas64*"):
        name = ctypes.CDLL(str(library)).scipy_openblas_get_corename64_
        name.restype = ctypes.c_char_p
        return str(name().decode())
    return ""


def repeated(path: Path, wanted: str, *noise: float) -> Said:
    """Diagnose a CSV file in a separate process."""
    environment = os.environ | ({"OPENBLAS_CORETYPE": wanted} if wanted else {})
    command = [sys.executable, "-m", "tools.benchmarks.prototype.stability", str(path), *map(str, noise)]
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, check=True)
    return Said(**json.loads(done.stdout))


def main(path: str, relative: str, degrees: str, seed: str) -> None:
    run = read_recording_csv(path)
    by = np.random.default_rng(int(seed)).standard_normal(run.theta.shape)
    run = replace(run, theta=run.theta * (1 + float(relative) * by) + np.radians(float(degrees)) * by)
    print(json.dumps(vars(said(diagnose([run], load_model("lamecc_prototype.yaml"), with_power=False)))))


if __name__ == "__main__":
    main(*sys.argv[1:])
