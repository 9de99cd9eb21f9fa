"""The executable ``viewer``."""

import os

from continuum_manipulator.nodekit.run import run

GIVES_WAY = 10
"""Increase of the nice value, so that the viewer does not delay other processes."""


def main() -> int:
    os.nice(GIVES_WAY)
    # The inverse kinematics solves small systems: two BLAS threads only disturb others. Read when NumPy is imported.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    return run("continuum_manipulator.viewer:ViewerNode")
