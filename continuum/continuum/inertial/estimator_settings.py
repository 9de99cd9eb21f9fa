"""What the angle estimator takes for rest, for lost, and for good enough."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from continuum.errors import InvalidValueError

_DEGREE = math.pi / 180


@dataclass(frozen=True)
class EstimatorSettings:
    """All are positive.

    Attributes:
        period: between samples [s].
        rates_are_means: a rate is the mean over the period before its time, as of sensors that sum up inside (the
            Xsens DOT); otherwise it is the rate at that time.
        time_constant: with which the inclination corrects the integrated rate at rest [s].
        bias_time: with which what is left of the bias is learned at rest [s].
        rest_window: how long a sensor has to be quiet to count as at rest [s].
        rest_rate: rate that is not exceeded at rest [rad/s]; slow pulling still is quiet.
        rest_spread: largest less smallest rate in the window at rest [rad/s].
        rest_force: how much the specific force may differ in size from that at the zero [m/s2].
        longest_gap: between a sensor's readings, after which its angle is lost until it rests again [s]; within less
            than half a swing's time an arm that was let go is seen to move.
        bias_left: of the gyroscopes after calibration [rad/s].
        inclination_error: of a link's angle by the accelerometer at rest [rad].
        largest_error: of a joint's angle that still counts as good, as the estimator reckons it [rad].
    """

    period: float = 1 / 60
    rates_are_means: bool = True
    time_constant: float = 1.0
    bias_time: float = 100.0
    rest_window: float = 0.5
    rest_rate: float = 20 * _DEGREE
    rest_sd: float = 4 * _DEGREE
    rest_force: float = 0.3
    longest_gap: float = 0.1
    bias_left: float = 0.01 * _DEGREE
    inclination_error: float = 0.1 * _DEGREE
    largest_error: float = 0.8 * _DEGREE

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name != "rates_are_means" and not 0 < value < math.inf:
                raise InvalidValueError(field.name, value, "a number > 0")
