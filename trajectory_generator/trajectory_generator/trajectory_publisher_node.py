"""The executable ``trajectory_publisher``."""

from continuum_manipulator.nodekit.run import run


def main() -> int:
    return run("trajectory_generator.trajectory_publisher:TrajectoryPublisherNode")
