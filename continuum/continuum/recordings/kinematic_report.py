"""Figures of a kinematic run: tracking errors of the tip, cable rates against those of lengths, lost messages."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.ik_result import IkStatus
from continuum.recordings.arm_recording import ArmRecording, Stamps


@dataclass(frozen=True)
class KinematicReport:
    """Figures of a run.

    Attributes:
        n_targets: poses recorded.
        n_solved: poses that the inverse kinematics reached within its tolerance.
        rate: targets per second of time by stamps [Hz].
        duration: time from the first stamp to the last [s].
        lost: number of missing messages, by stream.
        repeated: number of messages with a repeated stamp, by stream.
        tip_error_median, tip_error_max: distance from tip to target over the reached poses [m]; NaN if there is none.
        largest_rate: largest rate of any cable [m/s]; NaN if none was recorded.
        rate_disagreement: largest difference between a cable's rate and the central difference of its length [m/s];
            NaN if unknown.
    """

    n_targets: int
    n_solved: int
    rate: float
    duration: float
    lost: dict[str, int]
    repeated: dict[str, int]
    tip_error_median: float
    tip_error_max: float
    largest_rate: float
    rate_disagreement: float

    @property
    def n_lost(self) -> int:
        """Messages lost in all streams together."""
        return sum(self.lost.values())

    @property
    def rate_disagreement_ratio(self) -> float:
        """``rate_disagreement`` over ``largest_rate``; NaN for an arm at rest."""
        return self.rate_disagreement / self.largest_rate if self.largest_rate else math.nan


def report_on(recording: ArmRecording, n_expected: int | None = None) -> KinematicReport:
    """Compute the figures of a recorded run.

    Args:
        recording: the streams.
        n_expected: number of poses that the trajectory's publisher sent, if known.

    Raises:
        InvalidValueError: fewer than three poses or cable states.
    """
    stamps = recording.targets.stamps
    _at_least("number of poses in the recording", len(stamps), 3)
    _at_least("number of cable states in the recording", len(recording.lengths.stamps), 3)
    solved = recording.status.at(stamps)[:, 0] == IkStatus.SOLVED
    tips = arm_pose(recording.configurations.at(stamps), recording.arm)[:, :3, 3]
    errors = np.linalg.norm(tips - recording.targets.values, axis=-1)[solved]
    errors = errors[np.isfinite(errors)]  # without the poses whose joint states are lost
    duration = float(stamps[-1] - stamps[0]) * 1e-9
    inner, derivatives = central_differences(recording.lengths.stamps, recording.lengths.values)
    return KinematicReport(
        n_targets=len(stamps),
        n_solved=int(np.count_nonzero(solved)),
        rate=(len(stamps) - 1) / duration,
        duration=duration,
        lost=_lost(recording, n_expected or 0),
        repeated={name: len(stamps) - len(np.unique(stamps)) for name, stamps in recording.arrivals.items()},
        tip_error_median=float(np.median(errors)) if len(errors) else math.nan,
        tip_error_max=_largest(errors),
        largest_rate=_largest(recording.rates.values),
        rate_disagreement=_largest(recording.rates.values[inner] - derivatives),
    )


def _at_least(name: str, count: int, least: int) -> None:
    if count < least:
        raise InvalidValueError(name, count, f"{least} or more")


def _largest(values: Array) -> float:
    """Return the largest magnitude; NaN if all values are NaN."""
    known = np.abs(values[~np.isnan(values)])
    return float(np.max(known)) if len(known) else math.nan


def central_differences(stamps: Stamps, lengths: Array) -> tuple[Stamps, Array]:
    """Return the rows with a neighbour on both sides, and the derivatives of ``lengths`` (n, m) there [m/s].

    The derivative is that of the parabola through the three values: the central difference (f(t+h) - f(t-h)) / 2h if
    the stamps [ns] are even, and of second order next to a lost message too.
    """
    steps = np.diff(stamps)[:, None] * 1e-9
    derivatives = np.diff(lengths, axis=0) / steps
    before, after = steps[:-1], steps[1:]
    return np.arange(1, len(stamps) - 1), (after * derivatives[:-1] + before * derivatives[1:]) / (before + after)


def _lost(recording: ArmRecording, n_expected: int) -> dict[str, int]:
    """Return the number of stamps that each stream misses, of those in any stream or ``n_expected`` if that is more."""
    stamps = {name: np.unique(arrivals) for name, arrivals in recording.arrivals.items()}
    n_known = len(np.unique(np.concatenate(list(stamps.values()))))
    return {name: max(n_known, n_expected) - len(own) for name, own in stamps.items()}
