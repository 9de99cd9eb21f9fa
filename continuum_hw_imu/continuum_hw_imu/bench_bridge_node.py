"""The executable ``bench_bridge``."""

import os

from continuum_manipulator.nodekit.run import run


def main() -> int:
    # For small matrices, two BLAS threads are slower than one. NumPy reads this variable on import.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    return run("continuum_hw_imu.bench_bridge:BenchBridgeNode")
