"""What a kinematic run shows: how well the tip followed, whether cable rates are slopes of lengths, what was lost."""

from __future__ import annotations

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
        n_expected: poses that were published, as far as that is known; otherwise ``n_targets``.
        n_solved: poses that the inverse kinematics reached within its tolerance.
        rate: targets per second of the stamps' own time [Hz].
        duration: from the first stamp to the last [s].
        lost: messages that a stream misses, by stream.
        tip_error_median, tip_error_max: distance from tip to target over the reached poses [m].
        largest_rate: largest rate of any cable [m/s].
        rate_disagreement: largest difference of a cable's rate to the central difference of its length [m/s].
    """

    n_targets: int
    n_expected: int
    n_solved: int
    rate: float
    duration: float
    lost: dict[str, int]
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
        """``rate_disagreement`` over ``largest_rate``."""
        return self.rate_disagreement / self.largest_rate


def report_on(recording: ArmRecording, n_expected: int | None = None) -> KinematicReport:
    """Compute the figures of a recorded run.

    Args:
        recording: the streams.
        n_expected: how many poses the trajectory's publisher sent, if that is known.

    Raises:
        InvalidValueError: fewer than three poses or cable states, or none that was reached.
    """
    stamps = recording.targets.stamps
    _at_least("poses in the recording", len(stamps), 3)
    _at_least("cable states in the recording", len(recording.lengths.stamps), 3)
    solved = recording.status.at(stamps)[:, 0] == IkStatus.SOLVED
    _at_least("reached poses in the recording", int(np.count_nonzero(solved)), 1)
    tips = arm_pose(recording.configurations.at(stamps), recording.arm)[:, :3, 3]
    errors = np.linalg.norm(tips - recording.targets.values, axis=-1)[solved]
    duration = (stamps[-1] - stamps[0]) * 1e-9
    inner, slopes = central_differences(recording.lengths.stamps, recording.lengths.values)
    return KinematicReport(
        n_targets=len(stamps),
        n_expected=len(stamps) if n_expected is None else n_expected,
        n_solved=int(np.count_nonzero(solved)),
        rate=(len(stamps) - 1) / duration,
        duration=duration,
        lost=_lost(recording, len(stamps) if n_expected is None else n_expected),
        tip_error_median=float(np.median(errors)),
        tip_error_max=float(np.max(errors)),
        largest_rate=float(np.nanmax(np.abs(recording.rates.values))),
        rate_disagreement=float(np.nanmax(np.abs(recording.rates.values[inner] - slopes))),
    )


def _at_least(name: str, count: int, least: int) -> None:
    if count < least:
        raise InvalidValueError(name, count, f"{least} or more")


def central_differences(stamps: Stamps, lengths: Array) -> tuple[Stamps, Array]:
    """Rows with a neighbour on both sides, and (f(t+) - f(t-)) / (t+ - t-) of ``lengths`` (n, m) there [m/s]."""
    elapsed = (stamps[2:] - stamps[:-2]) * 1e-9
    return np.arange(1, len(stamps) - 1), (lengths[2:] - lengths[:-2]) / elapsed[:, None]


def _lost(recording: ArmRecording, n_expected: int) -> dict[str, int]:
    """Messages that each stream has less than poses were published."""
    counts = {
        "/traj_pose": len(recording.targets.stamps),
        "/joint_states": len(recording.configurations.stamps),
        "/ik_status": len(recording.status.stamps),
        "/cable_states": len(recording.lengths.stamps),
    }
    for i, count in enumerate(recording.section_counts):
        counts[f"/section_cable_states of section {i + 1}"] = count
    return {name: max(0, n_expected - count) for name, count in counts.items()}
