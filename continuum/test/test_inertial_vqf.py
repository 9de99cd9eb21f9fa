"""The estimator beside VQF, a well-kept orientation filter (Laidig, Seel, Information Fusion 91, 2023), on one arm.

VQF knows nothing of the plane in which the arm bends, and corrects by the accelerometer at all times. Its orientation
without magnetometer turns freely about the vertical, so that what can be compared is each link's inclination.
"""

import numpy as np
import pytest
from inertial_arm import (
    RELEASE,
    REST,
    Motion,
    N,
    SensorModel,
    calibrated,
    errors,
    estimated,
    pull_and_release,
    rms,
    sensed,
)
from vqf import VQF

from continuum.arrays import Array
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.inclination import inclination
from continuum.inertial.joint_angles import of_neighbours, within_half_a_turn

LIVE = 60.0


def vqf_angles(recording: ImuRecording) -> Array:
    """Joint angles (n_times, n) [rad] by the direction of gravity that VQF tells, with the same axes and zero."""
    known = calibrated(recording)
    up = np.empty(recording.forces.shape)
    for i in range(N):
        rates, forces = (np.ascontiguousarray(block[:, i]) for block in (recording.rates, recording.forces))
        w, x, y, z = VQF(1 / LIVE).updateBatch(rates, forces)["quat6D"].T
        up[:, i] = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), w**2 - x**2 - y**2 + z**2], axis=1)
    return within_half_a_turn(of_neighbours(inclination(up, known.axis, known.zero)))


def both(motion: Motion, seed: int) -> tuple[Array, Array, Array]:
    """Times, our errors and VQF's [degrees]."""
    recording, _ = sensed(motion, LIVE, SensorModel(), seed)
    theta, _ = motion.at(recording.times)
    ours = errors(estimated(recording, calibrated(recording)), motion)
    return recording.times, ours, np.degrees(vqf_angles(recording) - theta)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_two_filters_that_share_nothing_agree(seed: int) -> None:
    times, ours, theirs = both(pull_and_release(), seed)
    swing = (times > RELEASE) & (times < RELEASE + 2)
    rest = ((times > 1) & (times < REST)) | (times > times[-1] - 2)
    assert rms((ours - theirs)[swing]).max() < 0.3
    assert rms((ours - theirs)[rest]).max() < 0.5  # VQF is still learning its bias
    assert rms(theirs[swing]).max() < 0.3
    assert rms(ours[rest]).max() < rms(theirs[rest]).max()
