"""Errors of the bridge's angles relative to those of the emulated arm."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum_hw_imu.emulator.truth_file import read_truth
from continuum_manipulator.nodekit.stamps import NANOSECONDS
from continuum_manipulator.nodekit.two_clocks import read_together


def error_of_angles(received: list[tuple[int, Array]], truth_file: Path) -> Array:
    """Return published minus true joint angles, (n, n_joints) [rad].

    ``received`` holds pairs of stamp [ns] and angles (n_joints,) [rad].
    """
    truth = read_truth(truth_file)
    instant, now = read_together(time.monotonic, time.time_ns)
    since = instant - now / NANOSECONDS  # from ROS time to the truth file's clock
    at = np.array([stamp / NANOSECONDS + since for stamp, _ in received])
    true = np.stack([np.interp(at, truth["monotonic_s"], column) for column in truth["theta"].T], axis=1)
    return np.array([angles for _, angles in received]) - true


def rms_degrees(difference: Array) -> float:
    """Return the root mean square of angles [rad], in degrees."""
    return float(np.degrees(np.sqrt(np.mean(difference**2))))
