"""`continuum import-dot`: compute joint angles from exported Xsens DOT recordings and write a run for diagnose."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from continuum.arrays import Array
from continuum.cli.outputs import announce, check_outputs, write
from continuum.cli.tables import print_pairs
from continuum.errors import FileError, InvalidValueError, MeasurementError

if TYPE_CHECKING:
    from continuum.inertial.calibration_values import Calibration
    from continuum.inertial.imu_recording import ImuRecording
    from continuum.inertial.recorded_angles import RecordedAngles
    from continuum.inertial.time_grid import Stream

Span = tuple[float, float]


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "import-dot", help="compute joint angles from exported recordings of inertial sensors", description=__doc__,
        epilog="Times count in seconds from the start of the first sensor, as in the printed rests. A run without "
        "tensions has slack cables, so let it --begin after the release of the cable. "
        "Exit codes: 0 done, 1 written, but diagnose would refuse it, 2 wrong usage, file or value.",
    )  # fmt: skip
    parser.add_argument("files", nargs="+", metavar="FILE.csv", help="one export per sensor, in order from the base")
    parser.add_argument("--out", metavar="RECORDING.csv", help="write time, joint angles and rates to this file")
    parser.add_argument(
        "--first-turn", choices=("1", "2"), metavar="CABLE",
        help="1 or 2: the cable towards which the arm first turns in the recording; needed to find the sensors' axes",
    )  # fmt: skip
    parser.add_argument(
        "--zero", metavar="S:S", help="interval in which the arm rests straight, or in --posture, for example 0:5"
    )
    parser.add_argument("--posture", metavar="DEG", help="joint angles [degrees] at --zero, q1,q2,..; default straight")
    parser.add_argument(
        "--calibration", metavar="FILE.yaml",
        help="axes and zero of an earlier recording with the sensors in the same places; the bias is estimated again",
    )  # fmt: skip
    parser.add_argument("--save-calibration", metavar="OUT.yaml", help="write bias, axes and zero to this file")
    parser.add_argument("--begin", metavar="S", type=float, default=-math.inf, help="omit earlier rows")
    parser.add_argument("--end", metavar="S", type=float, default=math.inf, help="omit later rows")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Import the recordings, print a summary, and write the requested files."""
    from continuum.inertial.calibration_values import save_calibration
    from continuum.inertial.common_clock import check_common_clock, on_one_clock
    from continuum.inertial.dot_export import read_dot_export
    from continuum.inertial.estimator_settings import EstimatorSettings
    from continuum.inertial.recorded_angles import recorded_angles
    from continuum.inertial.stillness import rests
    from continuum.inertial.time_grid import on_one_grid

    check_outputs((*options.files, options.calibration), [options.out, options.save_calibration])
    exports = [read_dot_export(path) for path in options.files]
    streams = on_one_clock(exports)
    recording = on_one_grid(streams)
    check_common_clock(recording)
    found = rests(recording)
    for export in exports:
        for note in export.notes:
            print(f"continuum: {export.name}: {note}", file=sys.stderr)
    _show(recording, found, streams)
    if options.out is None and options.save_calibration is None:
        print("nothing written; --out names a file for the joint angles")
        return 0
    calibration = _calibration(options, recording, found)
    motion = None
    if options.out is not None:
        settings = EstimatorSettings(period=float(recording.times[1] - recording.times[0]))
        motion = _good_rows(recorded_angles(recording, calibration, settings), options.begin, options.end)
    write(options.save_calibration, lambda path: save_calibration(calibration, path))
    announce([options.save_calibration])
    return 0 if motion is None else _write(options.out, *motion)


def _show(recording: ImuRecording, found: list[Span], streams: Sequence[Stream]) -> None:
    """Print a summary. If sampling times differ, a missing reading leaves two common instants without values."""
    lasts = recording.times[-1] - recording.times[0]
    unknown, clipped = (block.mean(axis=0) for block in (~recording.valid, recording.clipped))
    spans = ", ".join(f"{begin:.2f} to {end:.2f}" for begin, end in found)
    pairs = [(f"sensor {number}", stream.name) for number, stream in enumerate(streams, start=1)]
    pairs += [
        ("together", f"{lasts:.2f} s, {(recording.times.size - 1) / lasts:.0f} readings a second"),
        ("missing", f"{_percent(stream.missing for stream in streams)} of the readings"),
        ("unknown", f"{_percent(unknown)} of the common instants"),
        ("clipped", f"{_percent(clipped)} of the common instants"),
        ("at rest", f"{spans} s" if found else "never for as long as a second"),
    ]
    print_pairs(pairs)


def _percent(shares: Iterable[float]) -> str:
    return ", ".join(f"{100 * share:.1f}" for share in shares) + " %"


def _calibration(options: argparse.Namespace, recording: ImuRecording, found: list[Span]) -> Calibration:
    from continuum.inertial.calibration import CalibrationSteps
    from continuum.inertial.calibration_values import load_calibration

    steps = CalibrationSteps()
    if options.calibration is not None:
        known = load_calibration(options.calibration)
        if known.n_sensors != recording.n_sensors:
            raise FileError(options.calibration, f"has {known.n_sensors} sensors, not {recording.n_sensors}")
        steps = CalibrationSteps.of(known)
    if not found:
        raise MeasurementError("the sensors never rest for a second, so their bias cannot be estimated")
    steps = steps.with_bias(recording.part(*max(found, key=lambda span: span[1] - span[0])))
    if options.first_turn is not None:
        steps = steps.with_axis(recording, 1 if options.first_turn == "1" else -1)
    if options.posture is not None and options.zero is None:
        raise InvalidValueError("--posture", options.posture, "only with --zero, the interval of this posture")
    if options.zero is not None:
        steps = steps.with_zero(recording.part(*_span(options.zero)), _posture(options.posture))
    calibration = steps.complete()
    if calibration is None:
        option = "--first-turn" if "axis" in steps.missing else "--zero"
        raise MeasurementError(f"the {steps.missing[0]} of the sensors is not known: give {option} or --calibration")
    return calibration


def _span(text: str) -> Span:
    begin, colon, end = text.partition(":")
    try:
        span = float(begin), float(end)
    except ValueError:
        span = math.nan, math.nan
    if not colon or not span[0] < span[1]:
        raise InvalidValueError("--zero", text, "two times in s with a colon between them, the earlier first")
    return span


def _posture(text: str | None) -> list[float] | None:
    """Parse joint angles [degrees] and return them [rad]; None without text."""
    try:
        return None if text is None else [math.radians(float(part)) for part in text.split(",")]
    except ValueError:
        raise InvalidValueError("--posture", text, "joint angles in degrees with commas between them") from None


def _good_rows(angles: RecordedAngles, begin: float, end: float) -> tuple[Array, Array, Array]:
    """Return times (n,) [s], angles and rates (n, n_joints) [rad, rad/s] of the rows with valid angles of all joints.

    Raises:
        MeasurementError: there is no such row from ``begin`` to ``end`` [s].
    """
    inside = (angles.times >= begin) & (angles.times <= end)
    good = inside & angles.good.all(axis=1)
    if not good.any():
        raise MeasurementError("no instant between --begin and --end has valid angles of all joints")
    left = int(inside.sum() - good.sum())
    print(f"{good.sum()} rows" + (f"; {left} without valid angles omitted" if left else ""))
    return angles.times[good], angles.theta[good], angles.theta_rate[good]


def _write(out: str, times: Array, theta: Array, theta_rate: Array) -> int:
    """Write the rows and read them as `diagnose` does; return 1 if it would refuse them."""
    from continuum.recordings.motion_table import write_measured_motion
    from continuum.recordings.recording_csv import read_recording_csv

    write(out, lambda path: write_measured_motion(times, theta, theta_rate, path))
    announce([out])
    try:
        read_recording_csv(out)
    except FileError as error:
        print(f"continuum: diagnose would refuse it: {error}", file=sys.stderr)
        return 1
    return 0
