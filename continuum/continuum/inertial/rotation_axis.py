"""The axis about which each sensor turns, from a motion of the arm in its plane.

Sensors on wooden plates are never exactly aligned, so the axis is not assumed but found: rates of a link that bends in
a plane lie on one line in the sensor's axes, the principal direction of their second moments.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError, MeasurementError
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.integrated_rate import integrated

LEAST_TURN = np.radians(5.0)
"""Least turn of every link, for its axis to be found [rad]."""

_OFF_AXIS = 0.15  # of the rates' size: more is not bending in a plane
_ALIKE = 0.5  # correlation of a link's angle with that of the last


def axes_of_motion(recording: ImuRecording, bias: Array, first_turn: int) -> Array:
    """Return unit vectors along the axes of the links, in each sensor's axes, (n, 3).

    Positive turns bend the arm towards cable 1. Rates do not show which side that is, so the person who moves the arm
    must state it: the side to which the last link first turns by half its way. The others turn mostly to the same side.

    Args:
        recording: recording of the arm bending in its plane by at least `LEAST_TURN` in the first joint, and some rest.
        bias: bias of the rates, (n, 3) [rad/s].
        first_turn: 1 if the arm first turns towards cable 1, -1 if away from it.

    Raises:
        InvalidValueError: ``first_turn`` is neither.
        MeasurementError: sensors that turned too little, about more than one axis, or against the others.
    """
    if first_turn not in (1, -1):
        raise InvalidValueError("first turn", first_turn, "1 (towards cable 1) or -1")
    rates = np.where(recording.good[:, :, None], recording.rates - bias, 0.0)
    moments = np.einsum("tni,tnj->nij", rates, rates)
    sizes, directions = np.linalg.eigh(moments)
    axes = directions[:, :, -1]
    angles = integrated(recording.times, np.einsum("tni,ni->tn", rates, axes))
    turns = np.ptp(angles, axis=0)
    off_axis = np.sqrt(np.maximum(sizes[:, 1], 0.0) / np.maximum(sizes[:, 2], np.finfo(float).tiny))  # eigh's rounding
    alike = _correlation(angles, angles[:, -1])
    wrong = [
        problem
        for sensor, (turn, off, like) in enumerate(zip(turns, off_axis, np.abs(alike), strict=True), start=1)
        if (problem := _fault(sensor, turn, off, like))
    ]
    if wrong:
        raise MeasurementError(f"no axes found: {'; '.join(wrong)}")
    last = angles[:, -1] - angles[0, -1]
    half_way = int(np.argmax(np.abs(last) >= np.abs(last).max() / 2))
    return np.asarray(axes * np.sign(alike)[:, None] * np.sign(last[half_way]) * first_turn)


def _fault(sensor: int, turn: float, off_axis: float, alike: float) -> str:
    if turn < LEAST_TURN:
        least = np.degrees(LEAST_TURN)
        return f"sensor {sensor} turned by {np.degrees(turn):.1f} degrees, {least:g} or more are needed"
    if off_axis > _OFF_AXIS:
        return f"sensor {sensor} turned about more than one axis, {off_axis:.0%} off the main one"
    if alike < _ALIKE:
        return f"sensor {sensor} did not turn as the last one did (correlation {alike:.2f}): which side is which?"
    return ""


def _correlation(angles: Array, reference: Array) -> Array:
    """Return the correlation of every column with the reference, (n,)."""
    columns, one = angles - angles.mean(axis=0), reference - reference.mean()
    size = np.sqrt(np.sum(columns**2, axis=0) * np.sum(one**2))
    return np.asarray(one @ columns / np.maximum(size, np.finfo(float).tiny))
