"""Whether a bench is the one that a node is set up for."""

from __future__ import annotations

from continuum_hw_imu.protocol.messages import Hello

LONGEST_SLACK_TIME = 5.0
"""A bench that lets cables go more slowly than this [s] is none to wait for."""

LONGEST_PATIENCE = 2.0
"""A bench that pulls on for longer than this without commands or heartbeats [s] is not safe to pull with."""


def deviance(hello: Hello, n_joints: int, n_cables: int) -> str:
    """Why a bench does not fit an arm, in words; empty where it does: one sensor on each link, and all cables.

    Its times count, too: the node waits for slack cables, and relies on the bench once it is dead itself.
    """
    links = sorted(sensor.link for sensor in hello.sensors)
    if links != list(range(1, n_joints + 1)):
        found = ", ".join(map(str, links))
        return f"{hello.firmware} has sensors on the links {found}; the model has {n_joints} joints, a sensor on each"
    if hello.n_cables != n_cables:
        return f"{hello.firmware} has {hello.n_cables} cables; the model has {n_cables}"
    slack_time = hello.limits.slack_time
    if slack_time > LONGEST_SLACK_TIME:
        return f"{hello.firmware} lets cables go in {slack_time:g} s; allowed: up to {LONGEST_SLACK_TIME:g} s"
    for word, patience in (("commands", hello.limits.command_timeout), ("heartbeats", hello.limits.heartbeat_timeout)):
        if patience > LONGEST_PATIENCE:
            return f"{hello.firmware} pulls on for {patience:g} s without {word}; allowed: up to {LONGEST_PATIENCE:g} s"
    return ""
