"""Several runs as one dataset, split by whole runs into those that a model is fitted to and those it is tested on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from continuum.errors import InvalidValueError
from continuum.recordings.cable_sides import refuse_swapped_cables
from continuum.recordings.recording import Recording

_PART_FOR_FIT = 0.6  # of the samples of a single run


@dataclass(frozen=True)
class Dataset:
    """Runs of one arm.

    Attributes:
        recordings: at least one; all of one arm.
    """

    recordings: tuple[Recording, ...]

    def __post_init__(self) -> None:
        if not self.recordings:
            raise InvalidValueError("recordings", (), "at least one")
        for recording in self.recordings:
            if recording.n_joints != self.recordings[0].n_joints:
                raise InvalidValueError(
                    f"joints of {recording.name}", recording.n_joints, f"{self.recordings[0].n_joints} as in the others"
                )
            refuse_swapped_cables(recording)
        for one, other in combinations(self.recordings, 2):
            if np.array_equal(one.theta, other.theta):
                raise InvalidValueError("recordings", f"{one.name} and {other.name}", "different runs: these are one")

    @property
    def n_joints(self) -> int:
        """Number of joints."""
        return self.recordings[0].n_joints


@dataclass(frozen=True)
class Split:
    """Two sets of runs, no run in both.

    Attributes:
        identification, validation: the sets.
        weakness: why the split proves less than whole runs would; empty where it does not.
    """

    identification: tuple[Recording, ...]
    validation: tuple[Recording, ...]
    weakness: str = ""

    @property
    def swapped(self) -> Split:
        """The sets in each other's place."""
        return Split(self.validation, self.identification, self.weakness)


def halves(recordings: Sequence[Recording]) -> Split:
    """Half and half, as the thesis did, each half with its share of every kind of run.

    Runs are sorted by kind (driven or free, side and size of the bend they begin with) and dealt in turns. One run
    alone is cut in two: its end, begun from the state measured there, tests what its beginning taught.
    """
    if len(recordings) == 1:
        run = recordings[0]
        cut = int(_PART_FOR_FIT * run.times.size)
        return Split(
            (replace(run.rows(slice(0, cut)), name=f"{run.name}, beginning"),),
            (replace(run.rows(slice(cut, None)), name=f"{run.name}, end"),),
            "one recording only: its end tests its beginning, so nothing shows that the answer holds for another run",
        )
    order = sorted(range(len(recordings)), key=lambda i: _kind(recordings[i]))
    first = [i for place, i in enumerate(order) if place % 4 in (0, 3)]
    return Split(
        tuple(recordings[i] for i in sorted(first)),
        tuple(recordings[i] for i in range(len(recordings)) if i not in first),
        "" if len(recordings) > 2 else "two recordings only: one is fitted, one tests",
    )


def _kind(recording: Recording) -> tuple[bool, bool, float]:
    bend = float(np.sum(recording.theta[0]))
    return recording.is_driven, bend > 0, abs(bend)
