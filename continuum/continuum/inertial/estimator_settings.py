"""What counts as rest, as lost and as good for the angle estimator."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from continuum.errors import InvalidValueError

_DEGREE = math.pi / 180


@dataclass(frozen=True)
class EstimatorSettings:
    """Settings of the angle estimator; all numbers are positive.

    Attributes:
        period: time between samples [s].
        rates_are_means: a rate is the mean over the period before its time, as from sensors that integrate internally
            (the Xsens DOT); otherwise it is the rate at that time.
        time_constant: time constant with which the inclination corrects the integrated rate at rest [s].
        bias_time: time constant with which the remaining bias is learned at rest [s].
        rest_window: time for which a sensor has to be quiet to count as at rest [s].
        rest_rate: largest rate at rest [rad/s]; slow pulling still counts as quiet.
        rest_rate_range: range of rates in the window at rest, largest minus smallest [rad/s].
        rest_force: largest difference in size between the specific force at rest and that at the zero [m/s2].
        longest_gap: gap in a sensor's readings after which its angle is lost until it rests again [s]; shorter than
            half a swing, so that the motion of a released arm is not missed.
        bias_left: remaining bias of the gyroscopes after calibration [rad/s].
        inclination_error: error of a link's angle from the accelerometer at rest [rad].
        largest_error: largest estimated error of a joint's angle that still counts as good [rad].
    """

    period: float = 1 / 60
    rates_are_means: bool = True
    time_constant: float = 1.0
    bias_time: float = 100.0
    rest_window: float = 0.5
    rest_rate: float = 20 * _DEGREE
    rest_rate_range: float = 4 * _DEGREE
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
