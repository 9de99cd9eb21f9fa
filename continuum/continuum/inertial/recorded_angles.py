"""Joint angles of a whole recording: the estimator from both ends, each weighted by its estimated error."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.inertial.angle_estimator import AngleEstimator
from continuum.inertial.calibration_values import Calibration
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.imu_sample import Truths
from continuum.inertial.inclination import of_neighbours


@dataclass(frozen=True)
class RecordedAngles:
    """Angles and rates of all joints; values that are not good are NaN.

    Attributes:
        times: (n_times,) [s].
        theta: (n_times, n) [rad].
        theta_rate: means over the period before each time, (n_times, n) [rad/s].
        good: (n_times, n).
    """

    times: Array
    theta: Array
    theta_rate: Array
    good: Truths


def recorded_angles(recording: ImuRecording, calibration: Calibration, settings: EstimatorSettings) -> RecordedAngles:
    """Run through the recording forwards and backwards.

    Backwards, only the gyroscopes' readings change sign. So rest after a motion counts as much as rest before it.

    Raises:
        InvalidValueError: rates at instants, or a calibration of another number of sensors.
    """
    if not settings.rates_are_means:
        raise InvalidValueError("rates_are_means", False, "True: in recordings, rates are means over the period")
    ahead, ahead_error = _passed(recording, calibration, settings)
    turned = replace(calibration, bias=-calibration.bias)
    back, back_error = _passed(_backwards(recording, settings.period), turned, settings)
    # Backwards, an estimate belongs to the beginning of a period, which is the time of the row before.
    back = np.concatenate([back[::-1][1:], ahead[-1:]])
    back_error = np.concatenate([back_error[::-1][1:], ahead_error[-1:]])
    good = np.isfinite(ahead) | np.isfinite(back)
    weight = np.where(np.isfinite(ahead), ahead_error**-2.0, 0.0)
    weight_back = np.where(np.isfinite(back), back_error**-2.0, 0.0)
    total = np.nan_to_num(ahead) * weight + np.nan_to_num(back) * weight_back
    with np.errstate(invalid="ignore"):
        theta = total / (weight + weight_back)
    rates = np.einsum("tni,ni->tn", recording.rates - calibration.bias, calibration.axis)
    rates = np.where(recording.good, rates, np.nan)
    joint_rates = of_neighbours(rates)
    good &= np.isfinite(joint_rates)
    return RecordedAngles(recording.times, np.where(good, theta, np.nan), np.where(good, joint_rates, np.nan), good)


def _passed(recording: ImuRecording, calibration: Calibration, settings: EstimatorSettings) -> tuple[Array, Array]:
    """Return angles, NaN where they are not good, and their errors, (n_times, n) each [rad]."""
    estimator = AngleEstimator(calibration, settings)
    estimates = [estimator.update(sample) for sample in recording.samples()]
    return np.array([e.angles for e in estimates]), np.array([e.errors for e in estimates])


def _backwards(recording: ImuRecording, period: float) -> ImuRecording:
    """Return the same motion from its end, with times that begin where they ended and rates of the other sign."""
    turned = slice(None, None, -1)
    return ImuRecording(
        period - recording.times[turned],
        -recording.rates[turned],
        recording.forces[turned],
        recording.clipped[turned],
        recording.valid[turned],
    )
