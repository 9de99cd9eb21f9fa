"""Subscriber to a bridge that records the arrival of each message; it stores little, so that it can run for long."""

from __future__ import annotations

import struct
import time
from dataclasses import dataclass
from typing import Any

from emulated_bench import N_SENSORS
from harness import Probe
from sensor_msgs.msg import Imu, JointState

from continuum.arrays import Array
from continuum_manipulator.nodekit.qos import STREAM
from continuum_manipulator.nodekit.stamps import NANOSECONDS, nanoseconds
from continuum_manipulator.nodekit.two_clocks import read_together
from continuum_msgs.msg import CableStates


@dataclass(frozen=True)
class State:
    """One joint state; times are of this machine's monotonic clock [s].

    Attributes:
        stamp: instant of its content.
        published: time at which the bridge passed it to DDS.
        received: time at which DDS received it in the subscriber's process.
        called: time at which the Python subscriber was called.
        angles: joint angles, (n,) [rad].
    """

    stamp: float
    published: float
    received: float
    called: float
    angles: Array


@dataclass(frozen=True)
class Sample:
    """Sample of one sensor: instant of its content, and time of its reception by DDS, by the monotonic clock [s]."""

    stamp: float
    received: float


class LatencyProbe:
    """Replacement of the tests' `Ears`: lists that grow with every message.

    Args:
        probe: probe whose node subscribes.
    """

    def __init__(self, probe: Probe) -> None:
        self.probe, self.bridges = probe, 0
        self.joints: list[State] = []
        self.cables: list[float] = []
        self.imus: list[list[Sample]] = [[] for _ in range(N_SENSORS)]
        listen = probe.node.create_subscription
        listen(JointState, "joint_states", self._on_joints, STREAM)
        listen(CableStates, "cable_states", self._on_cables, STREAM, raw=True)
        for k, samples in enumerate(self.imus, start=1):
            listen(Imu, f"imu_{k}/data_raw", _sample_taker(samples), STREAM, raw=True)
        self.say = probe.node.create_publisher(CableStates, "cable_tension_cmd", STREAM).publish

    def clear(self) -> None:
        for received in (self.joints, self.cables, *self.imus):
            received.clear()

    def _on_joints(self, message: JointState, info: dict[str, int]) -> None:
        called, past = time.monotonic(), since_boot()
        stamp = nanoseconds(message.header.stamp) / NANOSECONDS + past
        published, received = (info[f"{name}_timestamp"] / NANOSECONDS + past for name in ("source", "received"))
        self.joints.append(State(stamp, published, received, called, message.position[1:-1]))

    def _on_cables(self, data: bytes, info: dict[str, int]) -> None:  # noqa: ARG002
        self.cables.append(_stamp_of(data))


def since_boot() -> float:
    """Return the offset from this machine's time of day to its monotonic clock [s]."""
    instant, now = read_together(time.monotonic, time.time_ns)
    return instant - now / NANOSECONDS


def _sample_taker(samples: list[Sample]) -> Any:
    def take(data: bytes, info: dict[str, int]) -> None:
        past = since_boot()
        samples.append(Sample(_stamp_of(data) + past, info["received_timestamp"] / NANOSECONDS + past))

    return take


def _stamp_of(data: bytes) -> float:
    """Return the time in the header of a serialised message, after the four bytes for the byte order [s]."""
    sec, nanosec = struct.unpack_from("<iI" if data[1] & 1 else ">iI", data, 4)
    return float(sec + nanosec / NANOSECONDS)
