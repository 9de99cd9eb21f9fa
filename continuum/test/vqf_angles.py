"""Joint angles by VQF, an orientation filter for inertial sensors."""

import numpy as np
from inertial_arm import N, calibrated
from vqf import VQF

from continuum.arrays import Array
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.inclination import inclination, of_neighbours, within_half_a_turn


def vqf_angles(recording: ImuRecording) -> Array:
    """Joint angles (n_times, n) [rad] by the direction of gravity that VQF tells, with the same axes and zero."""
    known = calibrated(recording)
    period = float(np.median(np.diff(recording.times)))
    up = np.empty(recording.forces.shape)
    for i in range(N):
        rates, forces = (np.ascontiguousarray(block[:, i]) for block in (recording.rates, recording.forces))
        w, x, y, z = VQF(period).updateBatch(rates, forces)["quat6D"].T
        up[:, i] = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), w**2 - x**2 - y**2 + z**2], axis=1)
    return within_half_a_turn(of_neighbours(inclination(up, known.axis, known.zero)))
