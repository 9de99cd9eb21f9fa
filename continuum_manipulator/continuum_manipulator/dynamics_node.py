"""The executable ``dynamics``."""

import os

from continuum_manipulator.nodekit.run import run


def main() -> int:
    # For the integrator's small systems, two BLAS threads take ten times as long as one. NumPy reads this on import.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    return run("continuum_manipulator.dynamics:DynamicsNode")
