"""Exam: angle of a motor's shaft by two inertial sensors, compared with its encoder (data/imu_pair).

The shaft is vertical, so that gravity hardly depends on its angle, and it never rests. `continuum.inertial` receives
the sensor on the shaft, since the base does not move; the other methods receive both sensors and the axis found by it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import minimize_scalar

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.integrated_rate import integrated
from continuum.inertial.recorded_turn import RecordedTurn, recorded_turn
from continuum.inertial.stillness import angle_between
from tools.benchmarks.exams.exam_section import Section
from tools.benchmarks.exams.inertial_rivals import (
    complementary,
    raw_difference,
    vqf_offline,
    vqf_online,
    vqf_without_rests,
)
from tools.benchmarks.record import Figure
from tools.docs.markdown import paragraph, table

RUN = Path("data/imu_pair/yaw_slow.csv")
GRAVITY = 9.81  # m/s2 in a g of the file
ZEROED = 1.0  # s from the start, over which the mean error of every method defines its zero
LARGEST_DELAY = 0.1  # s
OURS = "continuum.inertial"
RIVALS: dict[str, Callable[[ImuRecording, Array], Array]] = {
    "VQF, offline": vqf_offline,
    "VQF": vqf_online,
    "VQF, no bias from rests": vqf_without_rests,
    "complementary filter": complementary,
    "integrated difference of the raw rates": raw_difference,
}


@dataclass(frozen=True)
class PairRun:
    """Two sensors, of which the second turns, and the encoder's angle, (n_times,) [rad]."""

    recording: ImuRecording
    encoder: Array


@dataclass(frozen=True)
class Score:
    """Errors of a method's angle against the encoder [degrees]: RMS, largest, and at the end."""

    method: str
    rms: float
    largest: float
    end: float


@dataclass(frozen=True)
class PairResult:
    """Results of the exam.

    Attributes:
        scores: scores of all methods, ours first.
        duration: duration of the run [s].
        upright: angle between the shaft and the mean specific force [degrees].
        delay: delay of the gyroscopes relative to the encoder [s].
        bias, bias_error: bias about the axis, estimated from gravity, and its standard deviation [degrees/s].
        true_bias, scale: rate = true_bias + scale times the encoder's rate, by least squares of the angles [degrees/s].
    """

    scores: tuple[Score, ...]
    duration: float
    upright: float
    delay: float
    bias: float
    bias_error: float
    true_bias: float
    scale: float


def read_run(path: Path = RUN) -> PairRun:
    """Read a file with the columns of data/imu_pair/README.md; omit rows with the time of the previous row.

    Raises:
        FileError: the file cannot be read, or lacks a column.
    """
    try:
        rows = np.genfromtxt(path, delimiter=",", names=True)
        axes = [[f"{kind}{i}_{axis}" for axis in "xyz"] for kind in ("gyro", "accel") for i in (1, 2)]
        t, degrees, blocks = rows["t_s"], rows["encoder_deg"], [np.stack([rows[a] for a in v], axis=1) for v in axes]
    except (OSError, ValueError) as error:
        raise FileError(path, f"is no run of a pair of sensors ({error})") from error
    new = np.diff(t, prepend=-np.inf) > 0
    rates, forces = np.radians(np.stack(blocks[:2], axis=1)), GRAVITY * np.stack(blocks[2:], axis=1)
    received = np.isfinite(rates).all(axis=2) & np.isfinite(forces).all(axis=2)
    recording = ImuRecording(t[new], rates[new], forces[new], np.zeros_like(received[new]), received[new])
    return PairRun(recording, np.unwrap(np.radians(degrees[new])))


def examined(run: PairRun) -> PairResult:
    """Evaluate every method, with the encoder's sign, one common delay, and individual zeros from the first second."""
    ours = shaft_turn(run)
    axis, times = ours.axis[0], run.recording.times
    raw = raw_difference(run.recording, axis)
    late = delay(times, raw, run.encoder)
    truth, known = delayed(times, run.encoder, late)
    found = {OURS: ours.angle[:, 0]} | {name: method(run.recording, axis) for name, method in RIVALS.items()}
    scores = tuple(_score(name, times[known], (angle - truth)[known]) for name, angle in found.items())
    unchanged = integrated(times, run.recording.rates[:, 1] @ axis[:, None])[:, 0]
    scale, bias, _ = _fitted(times[known], truth[known], unchanged[known])[0]
    upright = np.degrees(angle_between(run.recording.forces[:, 1].mean(axis=0), axis))
    return PairResult(
        scores, float(np.ptp(times)), min(upright, 180 - upright), late,
        float(np.degrees(ours.bias[0] @ axis)), float(np.degrees(ours.bias_error[0])), float(np.degrees(bias)), scale,
    )  # fmt: skip


def shaft_turn(run: PairRun) -> RecordedTurn:
    """Return the second sensor's rotation; its first direction, known to the operator, is taken from the encoder."""
    turn = run.encoder - run.encoder[0]
    first = turn[np.argmax(np.abs(turn) >= np.abs(turn).max() / 2)]
    r = run.recording
    moving = ImuRecording(r.times, r.rates[:, 1:], r.forces[:, 1:], r.clipped[:, 1:], r.valid[:, 1:])
    return recorded_turn(moving, 1 if first > 0 else -1)


def delay(times: Array, angle: Array, encoder: Array) -> float:
    """Return the delay [s] at which the encoder's angle best explains that of the gyroscopes.

    Scale, bias and zero are free, so that the result is independent of the errors of the methods.
    """

    def unexplained(late: float) -> float:
        truth, known = delayed(times, encoder, late)
        return float(np.sum(_fitted(times[known], truth[known], angle[known])[1] ** 2))

    return float(minimize_scalar(unexplained, bounds=(-LARGEST_DELAY, LARGEST_DELAY), method="bounded").x)


def delayed(times: Array, encoder: Array, late: float) -> tuple[Array, Array]:
    """Return the encoder's angle a delay before each time, and the mask of times at which all delays are covered."""
    known = (times >= times[0] + LARGEST_DELAY) & (times <= times[-1] - LARGEST_DELAY)
    return np.interp(times - late, times, encoder), known


def _fitted(times: Array, truth: Array, angle: Array) -> tuple[Array, Array]:
    """Fit scale, bias [rad/s] and zero [rad] of an angle by least squares; return them and the residuals [rad]."""
    columns = np.stack([truth, times - times[0], np.ones_like(times)], axis=1)
    values = np.linalg.lstsq(columns, angle, rcond=None)[0]
    return values, angle - columns @ values


def _score(method: str, times: Array, error: Array) -> Score:
    off = np.degrees(error - error[times <= times[0] + ZEROED].mean())
    return Score(method, float(np.sqrt(np.mean(off**2))), float(np.abs(off).max()), float(off[-1]))


def section() -> Section:
    """Return the section of the page, with the best rival."""
    result = examined(read_run())
    rows = [[s.method, f"{s.rms:.2f}", f"{s.largest:.2f}", f"{s.end:+.2f}"] for s in result.scores]
    head = ("method", f"RMS error over {result.duration:.0f} s [degrees]", "largest", "at the end")
    setting = paragraph(
        "Two MPU6050 at 100 Hz, one on a motor's shaft, the other at rest; the shaft's encoder is the reference",
        f"(data/imu_pair). By the accelerometer the shaft is {result.upright:.1f} degrees off the vertical. It turns",
        "back and forth by half a turn and never rests. The encoder gives the sign and nothing else to the methods.",
        f"The gyroscopes lag behind it by {1e3 * result.delay:.0f} ms, found with scale, bias and zero left free;",
        "every method is compared with it at that delay, minus the mean error of the first second.",
        "`continuum.inertial` and VQF's offline variant use later readings too. VQF has its default parameters; as it",
        "takes a moment of vibration for rest, it is also run without bias estimation from rests.",
    )
    reasons = paragraph(
        "About a vertical axis gravity does not correct the angle, and the gyroscope's bias adds up. Without a rest,",
        "only the small part of gravity across the axis shows the bias: it turns with the angle. From that",
        f"`recorded_turn` finds {result.bias:.3f} +- {result.bias_error:.3f} degrees/s; the encoder shows",
        f"{result.true_bias:.3f}. What remains is the error of that bias and the scale of the gyroscope,",
        f"{result.scale:.4f} by the encoder, which half turns about such an axis do not show.",
    )
    ours, best = result.scores[0], min(result.scores[1:], key=lambda score: score.rms)
    what = f"angle of a motor's shaft by an inertial sensor: RMS error over {result.duration:.0f} s"
    figure = Figure(what, ours.rms, "degrees", rival=best.method, rival_value=best.rms)
    text = "\n\n".join(["## Angle of a shaft by two inertial sensors", setting, table(head, rows), reasons])
    return Section(text, (figure,))
