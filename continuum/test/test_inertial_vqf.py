"""The estimator against VQF, a well-kept orientation filter (Laidig, Seel, Information Fusion 91, 2023), on one arm.

VQF knows nothing of the plane in which the arm bends, and corrects by the accelerometer at all times. Its orientation
without magnetometer turns freely about the vertical, so that what can be compared is each link's inclination.
"""

import numpy as np
import pytest
from inertial_arm import (
    RELEASE,
    REST,
    Motion,
    SensorModel,
    calibrated,
    errors,
    estimated,
    pull_and_release,
    rms,
    sensed,
)
from vqf_angles import vqf_angles

from continuum.arrays import Array

LIVE = 60.0


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
