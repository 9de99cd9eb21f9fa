"""The executable ``forward_kinematics``."""

from continuum_manipulator.nodekit.run import run


def main() -> int:
    return run("continuum_manipulator.forward_kinematics:ForwardKinematicsNode")
