"""Results of the inverse kinematics solvers: an unreachable target gives a status, never an exception."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array


class IkStatus(enum.IntEnum):
    """Outcome of a solution attempt. The values are those of the message ``continuum_msgs/IkStatus``."""

    SOLVED = 0
    LIMIT_REACHED = 1
    UNREACHABLE = 2
    NO_CONVERGENCE = 3


class IkResult(NamedTuple):
    """A configuration and how well it meets its target.

    Attributes:
        configuration: Allen coordinates (n_sections, 2) [rad].
        status: SOLVED within the tolerance; otherwise the reason, and the configuration is the nearest one found.
        iterations: number of iterations.
        distance: from the tip to the target position [m].
        angle: from the tip's z axis to the target direction, or from the tip frame to the target frame [rad]; 0 where
            the target sets neither.
    """

    configuration: Array
    status: IkStatus
    iterations: int
    distance: float
    angle: float

    @property
    def solved(self) -> bool:
        return self.status is IkStatus.SOLVED


@dataclass(frozen=True)
class IkBatch:
    """Results for many targets; row k of every array holds the :class:`IkResult` of target k.

    Attributes:
        configurations: (n_targets, n_sections, 2) [rad].
        statuses: (n_targets,), numbers of :class:`IkStatus`.
        iterations: (n_targets,).
        distances: (n_targets,) [m].
        angles: (n_targets,) [rad].
    """

    configurations: Array
    statuses: NDArray[np.int64]
    iterations: NDArray[np.int64]
    distances: Array
    angles: Array

    def __len__(self) -> int:
        return len(self.statuses)

    def __getitem__(self, k: int) -> IkResult:
        return IkResult(
            self.configurations[k],
            IkStatus(int(self.statuses[k])),
            int(self.iterations[k]),
            float(self.distances[k]),
            float(self.angles[k]),
        )

    @property
    def solved(self) -> NDArray[np.bool_]:
        """Mask of the targets that were solved, (n_targets,)."""
        solved: NDArray[np.bool_] = self.statuses == IkStatus.SOLVED
        return solved
