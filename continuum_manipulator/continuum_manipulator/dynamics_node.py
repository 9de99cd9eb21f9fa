"""The executable ``dynamics``."""

import os

from continuum_manipulator.nodekit.run import run


def main() -> int:
    # The integrator solves small systems: two BLAS threads take ten times as long as one. Read when NumPy is imported.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    return run("continuum_manipulator.dynamics:DynamicsNode")
