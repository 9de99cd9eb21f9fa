"""Check whether a bench matches the arm of a node."""

from __future__ import annotations

from continuum_hw_imu.protocol.messages import Hello

LONGEST_SLACK_TIME = 5.0
"""Longest release time of a bench that the node waits for [s]."""

LONGEST_PATIENCE = 2.0
"""Longest time for which a safe bench pulls on [s] without commands or heartbeats."""


def mismatch(hello: Hello, n_joints: int, n_cables: int) -> str:
    """Describe why a bench does not match an arm; empty if it does, with one sensor on each link and all cables.

    The times of the bench are checked too: the node waits for slack cables, and relies on the bench if the node dies.
    """
    links = sorted(sensor.link for sensor in hello.sensors)
    if links != list(range(1, n_joints + 1)):
        found = ", ".join(map(str, links))
        return f"{hello.firmware} has sensors on the links {found}; the model has {n_joints} joints, a sensor on each"
    if hello.n_cables != n_cables:
        return f"{hello.firmware} has {hello.n_cables} cables; the model has {n_cables}"
    slack_time = hello.limits.slack_time
    if slack_time > LONGEST_SLACK_TIME:
        return f"{hello.firmware} releases cables in {slack_time:g} s; allowed: up to {LONGEST_SLACK_TIME:g} s"
    for word, patience in (("commands", hello.limits.command_timeout), ("heartbeats", hello.limits.heartbeat_timeout)):
        if patience > LONGEST_PATIENCE:
            return f"{hello.firmware} pulls on for {patience:g} s without {word}; allowed: up to {LONGEST_PATIENCE:g} s"
    return ""
