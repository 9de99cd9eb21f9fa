"""Parameters of the node ``bench_bridge``, and what its calibration file says."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from continuum.errors import InvalidValueError
from continuum.inertial.calibration import load_calibration
from continuum.inertial.calibration_steps import CalibrationSteps
from continuum.parameter_spec import ParameterSpec
from continuum_hw_imu.sensor_quality import SensorQuality
from continuum_manipulator.nodekit import tension_parameters

AUTOSTARTS = ("none", "configure", "activate")
"""How far a node goes by itself. Sensors do no harm, so by default it opens the port; tension takes a person's word."""

PARAMETERS = (
    ParameterSpec("port", str, "serial port of the bench controller, or a link to it"),
    ParameterSpec("baud_rate", int, "speed of the port", "bit/s", 1200, 4_000_000, default=921_600),
    ParameterSpec("autostart", str, "how far the node goes by itself; tension takes activate",
                  choices=AUTOSTARTS, default="configure"),
    ParameterSpec("model", str, "model file of the arm, or the name of one that comes with the library",
                  default="lamecc_prototype.yaml"),
    ParameterSpec("section", str, "name of the section, with which those of joints and cables begin",
                  default="section_1"),
    ParameterSpec("calibration", str, "file of the sensors' calibration, read at the start if it is there, and "
                  "written when a calibration is complete; none without", default=""),
    ParameterSpec("keep_bias", bool, "take the file's bias as it is: for a node that begins again within minutes",
                  default=False),
    ParameterSpec("rest_time", float, "time at rest that bias and zero are taken from", "s", 1.0, 15.0,
                  default=3.0),
    ParameterSpec("rate_noise", float, "noise of the angular rates, standard deviation", "rad/s", 0.0, 1.0,
                  default=SensorQuality().rate_noise),
    ParameterSpec("force_noise", float, "noise of the accelerations, standard deviation", "m/s^2", 0.0, 10.0,
                  default=SensorQuality().force_noise),
    ParameterSpec("command_rate", float, "set points a second", "Hz", 20.0, 200.0, default=60.0),
    *tension_parameters.PARAMETERS,
)  # fmt: skip


def steps_from(file: str, n_joints: int, keep_bias: bool = False) -> CalibrationSteps:
    """What a calibration file says of the sensors of an arm; nothing where there is no file yet, or no name.

    Axes and zero last as long as the sensors sit where they are. The bias is another one every day, and 0.1 degrees/s
    of it would be 2 degrees in a release, told as good.

    Raises:
        ContinuumError: it cannot be read, is of another arm, or there is no folder to write it to.
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
