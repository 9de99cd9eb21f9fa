"""The executable ``recorder``."""

from continuum_manipulator.nodekit.run import run


def main() -> int:
    return run("continuum_manipulator.recorder:RecorderNode")
