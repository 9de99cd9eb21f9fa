"""The executable ``section``."""

from continuum_manipulator.nodekit.run import run


def main() -> int:
    return run("continuum_manipulator.section:SectionNode")
