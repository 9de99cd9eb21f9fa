"""Whether a bench is the one that a node is set up for."""

from __future__ import annotations

from continuum_hw_imu.protocol.messages import Hello


def misfit(hello: Hello, n_joints: int, n_cables: int) -> str:
    """Why a bench does not fit an arm, in words; empty where it does: one sensor on each link, and all cables."""
    links = sorted(sensor.link for sensor in hello.sensors)
    if links != list(range(1, n_joints + 1)):
        found = ", ".join(map(str, links))
        return f"{hello.firmware} has sensors on the links {found}; the model has {n_joints} joints, a sensor on each"
    if hello.n_cables != n_cables:
        return f"{hello.firmware} has {hello.n_cables} cables; the model has {n_cables}"
    return ""
