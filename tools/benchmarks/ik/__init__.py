"""Benchmark of the inverse kinematics."""
