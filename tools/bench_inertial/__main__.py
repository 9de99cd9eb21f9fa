"""`make bench-inertial`: errors of joint angles from inertial sensors, on a synthetic arm of which the truth is known.

The arm, its sensors and what happens to them are those of the tests (continuum/test/inertial_arm.py). Results of the
whole run overwrite the table of docs/inertial.md; those of a run with any option changed are printed alone.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from inertial_arm import (
    RELEASE,
    REST,
    Motion,
    SensorModel,
    calibrated,
    errors,
    estimated,
    pull_and_release,
    rms,
    sensed,
)
from inertial_faults import KINDS, losses
from vqf_angles import vqf_angles

from continuum.arrays import Array
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.recorded_angles import recorded_angles
from tools.markdown import replace_between, table
from tools.one_line import in_one_line

PAGE = Path("docs/inertial.md")
BEGIN, END = "<!-- made by `make bench-inertial` -->", "<!-- end -->"
LIVE, STORED = 60.0, 120.0

Method = Callable[[ImuRecording, Motion], Array]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=20, help="sets of sensors, each mounted and biased anew")
    options = parser.parse_args()
    motion = pull_and_release()
    text = "\n\n".join([accuracy(motion, options.seeds), faults(motion, options.seeds), speed(motion)])
    print(text)
    if options.seeds == parser.get_default("seeds"):
        replace_between(PAGE, BEGIN, END, text)
        print(f"written: {PAGE}")


def accuracy(motion: Motion, seeds: int) -> str:
    """Rows of every method."""
    methods: dict[str, tuple[float, bool, Method]] = {
        "live, 60 Hz, means": (LIVE, True, live(True)),
        "live, 60 Hz, rates at instants": (LIVE, False, live(False)),
        "offline, 120 Hz, means": (STORED, True, offline),
        "VQF, 60 Hz, means": (LIVE, True, by_vqf),
    }
    head = f"RMS of the worst joint [degrees], {seeds} sets of sensors: median (worst)", "at rest", "pulled", "released"
    rows = []
    for name, (rate, means, method) in methods.items():
        found = []
        for seed in range(seeds):
            recording, _ = sensed(motion, rate, SensorModel(means=means), seed)
            off, t = method(recording, motion), recording.times
            at_rest = ((t > 1) & (t < REST)) | (t > t[-1] - 2)
            spans = at_rest, (t > REST) & (t < RELEASE), (t > RELEASE) & (t < RELEASE + 2)
            found.append([rms(off[span]).max() for span in spans])
        cells = (f"{np.median(column):.2f} ({max(column):.2f})" for column in zip(*found, strict=True))
        rows.append([name, *cells])
    return table(head, rows)


def live(means: bool) -> Method:
    settings = EstimatorSettings(period=1 / LIVE, rates_are_means=means)
    return lambda recording, motion: errors(estimated(recording, calibrated(recording), settings), motion)


def offline(recording: ImuRecording, motion: Motion) -> Array:
    found = recorded_angles(recording, calibrated(recording), EstimatorSettings(period=1 / STORED))
    return np.degrees(found.theta - motion.at(recording.times)[0])


def by_vqf(recording: ImuRecording, motion: Motion) -> Array:
    return np.degrees(vqf_angles(recording) - motion.at(recording.times)[0])


def faults(motion: Motion, seeds: int) -> str:
    """Rows of every fault, live."""
    head = (
        "fault, live at 60 Hz",
        "largest error of what is good [degrees]",
        "RMS of the worst joint",
        "good while released",
    )
    rows = []
    for number, kind in enumerate(KINDS):
        largest, worst, good = [], [], []
        for seed in range(seeds):
            recording, _ = sensed(motion, LIVE, SensorModel(), seed)
            known, troubled = calibrated(recording), losses(kind, recording, np.random.default_rng([seed, number]))
            off = errors(estimated(troubled, known), motion)
            largest.append(np.nanmax(np.abs(off)))
            worst.append(rms(off).max())
            swing = (troubled.times > RELEASE) & (troubled.times < RELEASE + 2)
            good.append(np.isfinite(off[swing]).mean())
        rows.append([kind, f"{max(largest):.2f}", f"{max(worst):.2f}", f"{np.mean(good):.0%}"])
    return table(head, rows)


def speed(motion: Motion) -> str:
    recording, _ = sensed(motion, LIVE, SensorModel(), 0)
    known = calibrated(recording)
    began = time.perf_counter()
    estimated(recording, known)
    took = (time.perf_counter() - began) / recording.times.size
    return f"One sample of five sensors takes {took * 1e6:.0f} us of one core, {took * LIVE:.1%} at 60 Hz."


if __name__ == "__main__":
    sys.exit(in_one_line(main))
