"""Delays from sensor frames to their joint states, and frames without a joint state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum_hw_imu.protocol.frame import WRAP_TIME
from tools.benchmarks.link.latency_probe import State
from tools.benchmarks.link.truth import Truth


@dataclass(frozen=True)
class Delays:
    """Delays of each frame with its joint state, from the last byte that the emulator wrote; (n,) [s].

    Attributes:
        written: time of that byte by this machine's monotonic clock.
        published, received, called: see `State`.
        missing: number of frames without a joint state between the first and the last frame.
        shift: stamp minus the true instant.
    """

    written: Array
    published: Array
    received: Array
    called: Array
    missing: int
    shift: Array


def load_sent(path: Path, truth: Truth) -> tuple[Array, Array]:
    """Return the times at which each frame was written and measured, by the monotonic clock, (frames,) each [s]."""
    table = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    instants = dict(zip((truth.device.astype(np.int64) % WRAP_TIME).tolist(), truth.time.tolist(), strict=True))
    measured_at = np.array([instants[int(device)] for device in table[:, 1]])
    return table[:, 0], measured_at


def delays(states: Sequence[State], written: Array, measured_at: Array) -> Delays:
    """Match states to frames by the nearest instant, and return their delays.

    Args:
        states: joint states in the order of their stamps.
        written, measured_at: as returned by `load_sent`.
    """
    stamps = np.array([state.stamp for state in states])
    right = np.clip(np.searchsorted(measured_at, stamps), 1, len(measured_at) - 1)
    nearest = np.where(stamps - measured_at[right - 1] < measured_at[right] - stamps, right - 1, right)
    columns = (np.array([getattr(state, name) for state in states]) for name in ("published", "received", "called"))
    published, received, called = (column - written[nearest] for column in columns)
    missing = int(nearest[-1] - nearest[0] + 1 - np.unique(nearest).size)
    return Delays(written[nearest], published, received, called, missing, stamps - measured_at[nearest])
