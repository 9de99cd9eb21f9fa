"""How a calibration comes about: bias from rest, axes from a motion, zero from rest in a known posture, in any order.

What is found again replaces what was found before; what cannot be found leaves all as it was.
"""

from __future__ import annotations

from continuum.arrays import Array
from continuum.errors import InvalidValueError, MeasurementError
from continuum.inertial.calibration import Calibration
from continuum.inertial.gyro_bias import bias_at_rest
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.rotation_axis import axes_of_motion
from continuum.inertial.zeroing import zero_at_rest


class CalibrationSteps:
    """Of the sensors of one arm.

    Args:
        n_sensors: how many there are.
        known: where to begin, for example a calibration from a file.

    Raises:
        InvalidValueError: a calibration of another number of sensors.
    """

    def __init__(self, n_sensors: int, known: Calibration | None = None) -> None:
        if known is not None and known.n_sensors != n_sensors:
            raise InvalidValueError("sensors of the calibration", known.n_sensors, f"{n_sensors}, as there are")
        self._n_sensors = n_sensors
        self._found: dict[str, Array] = {}
        self._sources: dict[str, str] = {}
        self._known = known
        if known is not None:
            self._found = {"bias": known.bias, "axis": known.axis, "zero": known.zero}

    def find_bias(self, rest: ImuRecording) -> None:
        """From the arm at rest.

        Raises:
            MeasurementError: it moved.
        """
        self._found["bias"] = bias_at_rest(rest)
        self._sources["bias"] = f"{_lasting(rest)} of rest"

    def find_axes(self, motion: ImuRecording, first_turn: int) -> None:
        """From the arm bending in its plane, 1 if it first turns towards cable 1, -1 if away from it.

        Raises:
            MeasurementError: no bias is known, a link turned too little, or not about one axis.
            InvalidValueError: ``first_turn`` is something else.
        """
        if "bias" not in self._found:
            raise MeasurementError("no axes found: the bias has to be found first, from the arm at rest")
        self._found["axis"] = axes_of_motion(motion, self._found["bias"], first_turn)
        self._sources["axis"] = f"{_lasting(motion)} with motion"

    def set_zero(self, rest: ImuRecording, posture: object | None = None) -> None:
        """From the arm at rest, straight or with known joint angles (n,) [rad].

        Raises:
            MeasurementError: it moved, or it is not straight and the axes are not known.
            InvalidValueError: joint angles of another number, or too large.
        """
        if posture is not None and "axis" not in self._found:
            raise MeasurementError("no zero set: a posture that is not straight needs the axes first")
        axis = self._found.get("axis", rest.forces[0])
        self._found["zero"] = zero_at_rest(rest, axis, posture)
        self._sources["zero"] = f"{_lasting(rest)} {'straight' if posture is None else 'in a known posture'}"

    @property
    def missing(self) -> tuple[str, ...]:
        """What is still to be found, of bias, axis and zero."""
        return tuple(name for name in ("bias", "axis", "zero") if name not in self._found)

    def calibration(self) -> Calibration:
        """All of it together.

        Raises:
            MeasurementError: something is missing.
            InvalidValueError: what was found fits no sensor, for example an axis along gravity.
        """
        if self.missing:
            raise MeasurementError(f"not calibrated: {', '.join(self.missing)} not known")
        return Calibration(self._found["bias"], self._found["axis"], self._found["zero"], self._told())

    def _told(self) -> tuple[str, ...]:
        """What the values of each sensor are from, (n,)."""
        new = "; ".join(f"{name}: {source}" for name, source in self._sources.items())
        if self._known is None:
            return (new,) * self._n_sensors
        return tuple(f"{new}; else {old}" if new else old for old in self._known.sources)


def _lasting(recording: ImuRecording) -> str:
    return f"{recording.times[-1] - recording.times[0]:.1f} s"
