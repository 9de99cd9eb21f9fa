"""Bias of the gyroscopes: what they read at rest."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.stillness import CREEP, SETTLED, unrest


def bias_at_rest(recording: ImuRecording) -> Array:
    """Mean rates of an arm at rest, (n, 3) [rad/s].

    Raises:
        MeasurementError: the arm moved, a sensor was hardly heard, or it was too short; every sensor at fault is told.
    """
    return _means_at_rest(recording, recording.rates, CREEP, "the bias is found at rest only")


def force_at_rest(recording: ImuRecording) -> Array:
    """Mean specific forces of an arm at rest, (n, 3) [m/s2].

    Raises:
        MeasurementError: as for `bias_at_rest`.
    """
    return _means_at_rest(recording, recording.forces, SETTLED, "the zero is set at rest only")


def _means_at_rest(recording: ImuRecording, readings: Array, creep: float, rule: str) -> Array:
    moved = unrest(recording, creep)
    if moved:
        raise MeasurementError(f"{rule}: {'; '.join(moved)}")
    weights = recording.good[:, :, None]
    return np.asarray(np.where(weights, readings, 0.0).sum(axis=0) / weights.sum(axis=0))
