"""Launch a bench: its bridge, the frames of its arm and sensors, and without a port an emulated bench.

    ros2 launch continuum_hw_imu bench.launch.py                                      # emulated
    ros2 launch continuum_hw_imu bench.launch.py port:=/dev/ttyACM0 calibration:=$PWD/arm_sensors.yaml
    ros2 launch continuum_hw_imu bench.launch.py simulated:=true      # with a simulated arm under the same commands

Tension commands pass once the node is active (docs/bench.md); autostart:=activate activates it at the start. The frames
of the sensors are on the discs, and turned as the calibration file says, or like the discs if there is none yet.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from ament_index_python.packages import get_package_prefix
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_ros.actions import Node

from continuum.arm import Section
from continuum.dynamics.model_file import load_model
from continuum.inertial.calibration_values import load_calibration
from continuum.urdf.robot import Sensor
from continuum.viewer.model_arm import arm_of_model
from continuum_description.launching import (
    argument,
    frames,
    is_true,
    launch_file,
    node,
    number,
    switch,
    text,
)


def generate_launch_description() -> LaunchDescription:
    """Return the arguments and the processes."""
    arguments = [
        argument("port", "", "serial port of the bench controller; empty: an emulated one"),
        argument("baud_rate", "921600", "speed of the port in bit/s"),
        argument(
            "autostart", "configure", "transition up to which the bridge starts", ["none", "configure", "activate"]
        ),
        argument("model", "lamecc_prototype.yaml", "model or arm file, or name of one in the library"),
        argument("section", "", "section of an arm file with several, or name of the section of a model file"),
        argument("emulated_model", "", "model file of the emulated arm; empty: the same"),
        switch("simulated", "false", "node dynamics in the namespace simulated"),
        argument("calibration", "", "file of the sensors' calibration"),
        switch("keep_bias", "false", "use its bias, within minutes after its estimation"),
        switch("allow_uncalibrated", "false", "let the bridge be activated before it is calibrated"),
        argument("emulator_link", "/tmp/continuum_bench", "path of the link to the emulated port"),  # noqa: S108  (one bench)
        argument("emulator_control", "/tmp/continuum_bench_control", "socket that accepts orders (faults)"),  # noqa: S108
        argument("emulator_faults", "/dev/null", "file of orders for the emulated bench"),
        argument("emulator_truth", "/dev/null", "file for the true motion"),
    ]
    return launch_file(__file__, arguments, processes)


def processes(given: Mapping[str, str]) -> list[Node | ExecuteProcess]:
    """Return all processes.

    Raises:
        ContinuumError: the file of the model or of the calibration is invalid.
    """
    section = given["section"] or None
    arm = arm_of_model(given["model"], section, section)
    of_model = {"model": text(given["model"]), "section": text(given["section"])}
    parameters = {
        "port": text(given["port"] or given["emulator_link"]),
        "baud_rate": int(number(given, "baud_rate")),
        "autostart": given["autostart"],
        "calibration": text(given["calibration"]),
        "keep_bias": is_true(given["keep_bias"]),
        "allow_uncalibrated": is_true(given["allow_uncalibrated"]),
    }
    started = [] if given["port"] else [emulator(given)]
    started += [
        node("continuum_hw_imu", "bench_bridge", of_model, parameters),
        frames(arm, sensors=sensors(arm.sections[0], given)),
    ]
    if is_true(given["simulated"]):
        commands = [("cable_tension_cmd", "/cable_tension_cmd")]
        fast = {"integrator": "esdirk"}
        started.append(
            node("continuum_manipulator", "dynamics", of_model, fast, namespace="simulated", remappings=commands)
        )
    return started


def emulator(given: Mapping[str, str]) -> ExecuteProcess:
    """Return the emulated bench."""
    program = Path(get_package_prefix("continuum_hw_imu")) / "lib" / "continuum_hw_imu" / "bench_emulator"
    words = [str(program), "--model", given["emulated_model"] or given["model"]]
    for name in ("link", "control", "faults", "truth"):
        words += [f"--{name}", given[f"emulator_{name}"]]
    return ExecuteProcess(cmd=words, name="bench_emulator", output="screen")


def sensors(section: Section, given: Mapping[str, str]) -> list[Sensor]:
    """Return the sensors of the arm, one on every disc beyond its base."""
    rotations = [np.eye(3)] * section.n_joints
    if given["calibration"] and Path(given["calibration"]).exists():
        model = load_model(given["model"], given["section"] or None)
        rotations = load_calibration(given["calibration"]).mountings(float(model.parameters.hang_angle[0]))
    if len(rotations) != section.n_joints:
        raise RuntimeError(f"{given['calibration']} is of {len(rotations)} sensors; allowed: {section.n_joints}")
    discs = zip(section.disc_frames[1:], rotations, strict=True)
    return [Sensor(f"{section.name}_imu_{k}", disc, rotation) for k, (disc, rotation) in enumerate(discs, start=1)]
