"""The executable ``cable_estimator``."""

from continuum_manipulator.nodekit.run import run


def main() -> int:
    return run("continuum_manipulator.cable_estimator:CableEstimatorNode")
