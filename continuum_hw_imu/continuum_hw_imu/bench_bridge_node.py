"""The executable ``bench_bridge``."""

import os

from continuum_manipulator.nodekit.run import run


def main() -> int:
    # Small matrices, many times a second: two BLAS threads take longer than one. Read when NumPy is imported.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    return run("continuum_hw_imu.bench_bridge:BenchBridgeNode")
