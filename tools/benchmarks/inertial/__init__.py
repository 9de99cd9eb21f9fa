"""Benchmark of the joint angles from inertial sensors."""
