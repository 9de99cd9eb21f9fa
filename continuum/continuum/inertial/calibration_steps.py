"""A calibration in the making: bias from rest, axes from a motion, zero from rest in a known posture.

What is found again replaces what was found before; a step that fails leaves all as it was.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.calibration import Calibration
from continuum.inertial.gyro_bias import bias_at_rest
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.rotation_axis import axes_of_motion
from continuum.inertial.zeroing import zero_at_rest

_BETWEEN = "; "


@dataclass(frozen=True)
class CalibrationSteps:
    """What is known, each None until it is: bias, axis and zero as in `Calibration`, and what they were found from."""

    bias: Array | None = None
    axis: Array | None = None
    zero: Array | None = None
    sources: tuple[str, ...] = ()

    @classmethod
    def of(cls, calibration: Calibration) -> CalibrationSteps:
        """All of it."""
        return cls(calibration.bias, calibration.axis, calibration.zero, calibration.sources)

    @property
    def missing(self) -> tuple[str, ...]:
        """Steps that are still to be done."""
        return tuple(name for name in ("bias", "axis", "zero") if getattr(self, name) is None)

    def complete(self) -> Calibration | None:
        """The calibration, once every step is done.

        Raises:
            InvalidValueError: the steps do not fit each other, as an axis along gravity.
        """
        if self.bias is None or self.axis is None or self.zero is None:
            return None
        return Calibration(self.bias, self.axis, self.zero, self.sources)

    def with_bias(self, rest: ImuRecording) -> CalibrationSteps:
        """The bias from an arm at rest.

        Raises:
            MeasurementError: it moved; the sensors that did are told.
        """
        return replace(self, bias=bias_at_rest(rest), sources=self._with_source("bias", rest))

    def with_axis(self, motion: ImuRecording, first_turn: int = 1) -> CalibrationSteps:
        """The axes from an arm that bends in its plane, 1 if it first turns towards cable 1, -1 if away from it.

        Raises:
            MeasurementError: the bias is not known yet, or the motion does not show the axes.
            InvalidValueError: ``first_turn`` is something else.
        """
        if self.bias is None:
            raise MeasurementError("no axes without the bias; find it first, with the arm at rest")
        axis = axes_of_motion(motion, self.bias, first_turn)
        return replace(self, axis=axis, sources=self._with_source("axis", motion))

    def with_zero(self, rest: ImuRecording, posture: object | None = None) -> CalibrationSteps:
        """The zero from an arm at rest, straight or with known joint angles (n,) [rad].

        Raises:
            MeasurementError: it moved, or it is not straight and the axes are not known.
            InvalidValueError: joint angles of another number, or too large.
        """
        if posture is not None and self.axis is None:
            raise MeasurementError("no zero from a posture that is not straight without the axes; find them first")
        axis = np.zeros((rest.n_sensors, 3)) if self.axis is None else self.axis
        return replace(self, zero=zero_at_rest(rest, axis, posture), sources=self._with_source("zero", rest))

    def _with_source(self, step: str, recording: ImuRecording) -> tuple[str, ...]:
        """What each sensor's values were found from, this step the latest."""
        source = f"{step} of {np.ptp(recording.times):.1f} s"
        before = self.sources or ("",) * recording.n_sensors
        kept = ([part for part in text.split(_BETWEEN) if part and not part.startswith(step)] for text in before)
        return tuple(_BETWEEN.join([*parts, source]) for parts in kept)
