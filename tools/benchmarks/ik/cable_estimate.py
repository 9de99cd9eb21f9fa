"""Estimation of configurations from noisy cable lengths: errors, refused estimates, and times.

    python3 -m tools.benchmarks.ik.cable_estimate

Writes its record and overwrites two tables of docs/cable-estimate.md. Arms of 1 to 6 sections of the prototype are in
random postures within their bend limits.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.cable_estimate import CableEstimate, EstimateStatus, estimate_configuration
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.routing import tangle
from tools.benchmarks.ik.sample import prototype_arm
from tools.benchmarks.record import Figure, Record, Table
from tools.benchmarks.report import as_text, publish
from tools.one_line import in_one_line

COMMAND = "python3 -m tools.benchmarks.ik.cable_estimate"
POSTURES, SECTIONS, CABLES = 500, range(1, 7), (3, 4, 6)
NOISE = (0.0, 0.5e-3, 1e-3, 2e-3, 3e-3)  # standard deviations [m]
LEAST_SD = 1e-6  # what the node `cable_estimator` permits [m]


@dataclass(frozen=True)
class Trial:
    """Estimates of one arm's postures (n, n_sections, 2) [rad], and their processor times [s]."""

    arm: Arm
    postures: Array
    estimates: list[CableEstimate]
    times: list[float]

    @property
    def refused(self) -> int:
        """Number of estimates that the node `cable_estimator` does not publish."""
        published = (EstimateStatus.CONVERGED, EstimateStatus.INCONSISTENT)
        return sum(one.status not in published for one in self.estimates)

    @property
    def error(self) -> float:
        """Root mean square error of a coordinate [rad]."""
        return float(np.sqrt(np.mean([(one.w - w) ** 2 for one, w in zip(self.estimates, self.postures, strict=True)])))

    @property
    def expected(self) -> float:
        """Root mean square error according to the covariances [rad]."""
        return float(np.sqrt(np.mean([one.covariance.diagonal() for one in self.estimates])))

    @property
    def reduced_chi_square(self) -> float:
        """Mean chi-square over its degrees of freedom."""
        return float(np.mean([one.chi_square for one in self.estimates])) / self.estimates[0].degrees_of_freedom


def main() -> None:
    trials = {(noise, cables): [trial(n, cables, noise) for n in SECTIONS] for cables in CABLES for noise in NOISE}
    record = record_of(trials)
    print(as_text(record))
    publish(record)


def record_of(trials: Mapping[tuple[float, int], Sequence[Trial]]) -> Record:
    """Return the record of trials by noise [m] and cables of a section, for arms of each number of sections."""
    every = [trial for some in trials.values() for trial in some]
    noisy = [trial for (noise, _), some in trials.items() if noise > 0.0 for trial in some]
    n, slowest = sum(len(one.estimates) for one in every), time_rows(trials)
    figures = (
        Figure("posture from cable lengths: refused estimates", sum(one.refused for one in every), n=n),
        Figure(
            "posture from cable lengths: largest root mean square error over its standard deviation",
            max(one.error / one.expected for one in noisy),
        ),
        Figure("posture of six sections from cable lengths: processor time, median", max(slowest[-1]), "us"),
    )
    head = ("sections", *(f"{cables} cables [us]" for cables in CABLES))
    times = [(n_sections, *(f"{one:.0f}" for one in row)) for n_sections, row in zip(SECTIONS, slowest, strict=True)]
    tables = {"sweep": sweep_table(trials.items()), "times": Table.of(head, times)}
    return Record("cable-estimate", COMMAND, figures, tables)


def trial(n_sections: int, n_cables: int, noise: float) -> Trial:
    random = np.random.default_rng([n_sections, n_cables])
    azimuths = tuple(2 * np.pi * j / n_cables for j in range(n_cables))
    arm = Arm(tuple(replace(section, cable_azimuths=azimuths) for section in prototype_arm(n_sections).sections))
    limits = np.array([section.bend_limit for section in arm.sections])
    shape = (POSTURES, n_sections)
    postures = allen_from_jones(random.uniform(-np.pi, np.pi, shape), random.uniform(0.0, limits, shape))
    lengths = tangle(postures, arm)
    lengths = lengths + noise * random.normal(size=lengths.shape)
    estimates, times = [], []
    for one in lengths:
        began = time.thread_time()
        estimates.append(estimate_configuration(one, arm, max(noise, LEAST_SD)))
        times.append(time.thread_time() - began)
    return Trial(arm, postures, estimates, times)


def sweep_table(trials: Iterable[tuple[tuple[float, int], Sequence[Trial]]]) -> Table:
    head = (
        "cables of a section", "noise [mm]", "estimates", "refused", "expected [°], 1 section", "6 sections",
        "largest ratio of error to expected", "mean chi-square over degrees of freedom", "largest residual over noise",
        "most steps",
    )  # fmt: skip
    rows = [(str(cables), f"{1e3 * noise:g}", *_figures(noise, some)) for (noise, cables), some in trials]
    return Table.of(head, rows)


def _figures(noise: float, trials: Sequence[Trial]) -> tuple[str, ...]:
    estimates = [one for some in trials for one in some.estimates]
    steps = str(max(one.iterations for one in estimates))
    counts = str(len(estimates)), str(sum(one.refused for one in trials))
    if noise == 0.0:
        return *counts, "", "", f"errors up to {max(one.error for one in trials):.0e} rad", "", "", steps
    chi_squares = [one.reduced_chi_square for one in trials]
    return (
        *counts,
        *(f"{np.degrees(one.expected):.2f}" for one in (trials[0], trials[-1])),
        f"{max(one.error / one.expected for one in trials):.2f}",
        f"{min(chi_squares):.2f} to {max(chi_squares):.2f}",
        f"{max(np.abs(one.residuals).max() for one in estimates) / noise:.1f}",
        steps,
    )


def time_rows(trials: Mapping[tuple[float, int], Sequence[Trial]]) -> list[list[float]]:
    """Return medians [us] by sections and cables at the largest noise, which needs the most steps."""
    slow = [trials[NOISE[-1], cables] for cables in CABLES]
    return [[1e6 * statistics.median(some[i].times) for some in slow] for i in range(len(SECTIONS))]


if __name__ == "__main__":
    sys.exit(in_one_line(main))
