"""`make bench-inertial`: errors of joint angles from inertial sensors, on a synthetic arm with known angles.

The arm, its sensors and their faults are those of the tests (continuum/test/inertial_arm.py). The record of a complete
run is written and shown in docs/inertial.md; that of a run with changed options is only printed.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Mapping, Sequence

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
from tools.benchmarks.record import Figure, Record, Table
from tools.benchmarks.report import as_text, publish
from tools.one_line import in_one_line

LIVE, STORED = 60.0, 120.0
OURS, VQF = "live, 60 Hz, means", "VQF, 60 Hz, means"

Method = Callable[[ImuRecording, Motion], Array]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=20, help="sets of sensors, each mounted and biased anew")
    options = parser.parse_args()
    motion = pull_and_release()
    record = record_of(accuracy(motion, options.seeds), faults(motion, options.seeds), speed(motion))
    print(as_text(record))
    if options.seeds == parser.get_default("seeds"):
        publish(record)


def record_of(off: Mapping[str, Array], troubled: Sequence[Sequence[str]], seconds: float) -> Record:
    """Return the record of the errors of all methods, the rows of faults, and the time for one sample [s]."""
    ours, rival = (off[name].max(axis=0) for name in (OURS, VQF))
    figures = [
        Figure(
            f"joint angles by inertial sensors, {when}: RMS of the worst joint, worst set of sensors", ours[k],
            "degrees", at_most=most, rival="VQF", rival_value=rival[k],
        )
        for k, when, most in ((2, "released", 0.5), (0, "at rest", 0.3))
    ]  # fmt: skip
    figures.append(Figure("five inertial sensors at 60 Hz: part of one core", 100 * seconds * LIVE, "%"))
    sets = len(off[OURS])
    rows = [
        (name, *(f"{np.median(column):.2f} ({max(column):.2f})" for column in errors.T)) for name, errors in off.items()
    ]
    head = f"RMS of the worst joint [degrees], {sets} sets of sensors: median (worst)", "at rest", "pulled", "released"
    of_faults = (
        "fault, live at 60 Hz", "largest error of valid angles [degrees]", "RMS of the worst joint",
        "valid while released",
    )  # fmt: skip
    tables = {"errors": Table.of(head, rows), "faults": Table.of(of_faults, troubled)}
    return Record("inertial", "make bench-inertial", tuple(figures), tables)


def accuracy(motion: Motion, seeds: int) -> dict[str, Array]:
    """Return for every method the RMS of the worst joint at rest, pulled and released, (seeds, 3) [degrees]."""
    methods: dict[str, tuple[float, bool, Method]] = {
        OURS: (LIVE, True, live(True)),
        "live, 60 Hz, rates at instants": (LIVE, False, live(False)),
        "offline, 120 Hz, means": (STORED, True, offline),
        VQF: (LIVE, True, by_vqf),
    }
    errors_of = {}
    for name, (rate, means, method) in methods.items():
        found = []
        for seed in range(seeds):
            recording, _ = sensed(motion, rate, SensorModel(means=means), seed)
            off, t = method(recording, motion), recording.times
            at_rest = ((t > 1) & (t < REST)) | (t > t[-1] - 2)
            spans = at_rest, (t > REST) & (t < RELEASE), (t > RELEASE) & (t < RELEASE + 2)
            found.append([rms(off[span]).max() for span in spans])
        errors_of[name] = np.array(found)
    return errors_of


def live(means: bool) -> Method:
    settings = EstimatorSettings(period=1 / LIVE, rates_are_means=means)
    return lambda recording, motion: errors(estimated(recording, calibrated(recording), settings), motion)


def offline(recording: ImuRecording, motion: Motion) -> Array:
    found = recorded_angles(recording, calibrated(recording), EstimatorSettings(period=1 / STORED))
    return np.degrees(found.theta - motion.at(recording.times)[0])


def by_vqf(recording: ImuRecording, motion: Motion) -> Array:
    return np.degrees(vqf_angles(recording) - motion.at(recording.times)[0])


def faults(motion: Motion, seeds: int) -> list[list[str]]:
    """Return the rows of all faults with the live estimator."""
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
    return rows


def speed(motion: Motion) -> float:
    """Return the processor time for one sample of five sensors [s]."""
    recording, _ = sensed(motion, LIVE, SensorModel(), 0)
    known = calibrated(recording)
    began = time.perf_counter()
    estimated(recording, known)
    return (time.perf_counter() - began) / recording.times.size


if __name__ == "__main__":
    sys.exit(in_one_line(main))
