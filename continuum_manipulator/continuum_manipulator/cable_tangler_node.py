"""The executable ``cable_tangler``."""

from continuum_manipulator.nodekit.run import run


def main() -> int:
    return run("continuum_manipulator.cable_tangler:CableTanglerNode")
