"""A calibration step by step: bias from rest, axes from a motion, zero from rest in a known posture.

A repeated step replaces its earlier result; a step that fails changes nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.at_rest import bias_at_rest, zero_at_rest
from continuum.inertial.calibration_values import Calibration
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.rotation_axis import axes_of_motion

_BETWEEN = "; "


@dataclass(frozen=True)
class CalibrationSteps:
    """Bias, axis and zero as in `Calibration`, each None until it is known, and their sources."""

    bias: Array | None = None
    axis: Array | None = None
    zero: Array | None = None
    sources: tuple[str, ...] = ()

    @classmethod
    def of(cls, calibration: Calibration) -> CalibrationSteps:
        """Return the completed steps of a calibration."""
        return cls(calibration.bias, calibration.axis, calibration.zero, calibration.sources)

    @property
    def missing(self) -> tuple[str, ...]:
        """Steps that are still to be done, in their order."""
        return tuple(name for name in ("bias", "zero", "axis") if getattr(self, name) is None)

    def complete(self) -> Calibration | None:
        """Return the calibration once every step is done, else None.

        Raises:
            InvalidValueError: the steps contradict each other, as an axis along gravity does.
        """
        if self.bias is None or self.axis is None or self.zero is None:
            return None
        return Calibration(self.bias, self.axis, self.zero, self.sources)

    def with_bias(self, rest: ImuRecording) -> CalibrationSteps:
        """Add the bias from an arm at rest.

        Raises:
            MeasurementError: it moved; the message names the sensors that did.
        """
        return replace(self, bias=bias_at_rest(rest), sources=self._with_source("bias", rest))

    def with_axis(self, motion: ImuRecording, first_turn: int = 1) -> CalibrationSteps:
        """Add the axes from an arm that bends in its plane; ``first_turn`` is 1 towards cable 1, -1 away from it.

        Raises:
            MeasurementError: the bias is not known yet, or the motion does not show the axes.
            InvalidValueError: ``first_turn`` is something else.
        """
        if self.bias is None:
            raise MeasurementError("no axes without the bias; find it first, with the arm at rest")
        axis = axes_of_motion(motion, self.bias, first_turn)
        return replace(self, axis=axis, sources=self._with_source("axis", motion))

    def with_zero(self, rest: ImuRecording, posture: object | None = None) -> CalibrationSteps:
        """Add the zero from an arm at rest, straight or with known joint angles (n,) [rad].

        Raises:
            MeasurementError: it moved, or it is not straight and the axes are not known.
            InvalidValueError: joint angles of another number, or too large.
        """
        if posture is not None and self.axis is None:
            raise MeasurementError("no zero from a posture that is not straight without the axes; find them first")
        axis = np.zeros((rest.n_sensors, 3)) if self.axis is None else self.axis
        return replace(self, zero=zero_at_rest(rest, axis, posture), sources=self._with_source("zero", rest))

    def _with_source(self, step: str, recording: ImuRecording) -> tuple[str, ...]:
        """Return the sources of each sensor's values, this step last."""
        source = f"{step} of {np.ptp(recording.times):.1f} s"
        before = self.sources or ("",) * recording.n_sensors
        kept = ([part for part in text.split(_BETWEEN) if part and not part.startswith(step)] for text in before)
        return tuple(_BETWEEN.join([*parts, source]) for parts in kept)
