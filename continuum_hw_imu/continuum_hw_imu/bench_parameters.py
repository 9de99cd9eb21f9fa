"""Parameters of the node ``bench_bridge``, and its calibration file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from continuum.errors import InvalidValueError
from continuum.inertial.calibration import CalibrationSteps
from continuum.inertial.calibration_values import load_calibration
from continuum.parameter_spec import ParameterSpec
from continuum_hw_imu.sensor_quality import SensorQuality
from continuum_manipulator.nodekit import tension_parameters
from continuum_manipulator.nodekit.planar_arm import SECTION

AUTOSTARTS = ("none", "configure", "activate")
"""States that a node may enter by itself. By default it opens the port; only the user enables tension."""

PARAMETERS = (
    ParameterSpec("port", str, "serial port of the bench controller, or a link to it"),
    ParameterSpec("baud_rate", int, "speed of the port", "bit/s", 1200, 4_000_000, default=921_600),
    ParameterSpec("autostart", str, "transition up to which the node starts by itself; tension needs activate",
                  choices=AUTOSTARTS, default="configure"),
    ParameterSpec("model", str, "model file of the arm, or name of a model in the library",
                  default="lamecc_prototype.yaml"),
    SECTION,
    ParameterSpec("calibration", str, "file of the sensors' calibration, read at the start if it exists, and "
                  "written when a calibration is complete; empty for no file", default=""),
    ParameterSpec("keep_bias", bool, "use the bias in the file: for a node that restarts within minutes",
                  default=False),
    ParameterSpec("allow_uncalibrated", bool, "whether the node may be activated without a complete calibration, for "
                  "example to bend the arm by a cable for find_axes", default=False),
    ParameterSpec("lost_angles_timeout", float, "time without known angles after which tight cables are released and "
                  "commands are refused", "s", 0.05, 3600.0, default=1.0),
    ParameterSpec("rest_time", float, "time at rest from which bias and zero are estimated", "s", 1.0, 15.0,
                  default=3.0),
    ParameterSpec("rate_noise", float, "noise of the angular rates, standard deviation", "rad/s", 0.0, 1.0,
                  default=SensorQuality().rate_noise),
    ParameterSpec("force_noise", float, "noise of the accelerations, standard deviation", "m/s^2", 0.0, 10.0,
                  default=SensorQuality().force_noise),
    ParameterSpec("command_rate", float, "set points per second", "Hz", 20.0, 200.0, default=60.0),
    *tension_parameters.PARAMETERS,
)  # fmt: skip


def steps_from(file: str, n_joints: int, keep_bias: bool = False) -> CalibrationSteps:
    """Read a calibration file of an arm's sensors; return empty steps if there is no file yet, or no name.

    Axes and zero are valid as long as the sensors are not moved. The bias changes from day to day, and an error of
    0.1 degrees/s would cause an unnoticed error of 2 degrees in a release.

    Raises:
        ContinuumError: the file cannot be read, belongs to another arm, or its folder does not exist.
    """
    if not file:
        return CalibrationSteps()
    if not Path(file).exists():
        if not Path(file).absolute().parent.is_dir():
            raise InvalidValueError("calibration", file, "a file in a folder that exists")
        return CalibrationSteps()
    calibration = load_calibration(file)
    if calibration.n_sensors != n_joints:
        allowed = f"{n_joints}, one for each joint of the model"
        raise InvalidValueError(f"number of sensors in {file}", calibration.n_sensors, allowed)
    steps = CalibrationSteps.of(calibration)
    return steps if keep_bias else replace(steps, bias=None)
