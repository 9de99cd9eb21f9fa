"""The executable ``viewer``."""

import os

from continuum_manipulator.nodekit.run import run


def main() -> int:
    # The inverse kinematics solves small systems: two BLAS threads only disturb others. Read when NumPy is imported.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    return run("continuum_manipulator.viewer:ViewerNode")
