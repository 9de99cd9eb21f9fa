"""What the data can tell of the parameters at all: rank, conditioning and correlations of the Fisher information."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.identification.fit import Fit
from continuum.identification.free import Free

_TOLD = 0.5  # of a parameter's prior variance must be gone, else the data say nothing of it
_CORRELATED = 0.95


@dataclass(frozen=True)
class Identifiability:
    """What was learnt of each unknown.

    Attributes:
        unknowns: of the fit.
        learnt: part of each one's prior standard deviation that the data took away, 0 to 1, (k,).
        correlation: of the estimates, (k, k).
        condition: ratio of the largest to the smallest singular value of the data's own information, scaled by the
            prior.
        rank: number of directions of which the data tell more than the prior.
    """

    unknowns: tuple[Free, ...]
    learnt: Array
    correlation: Array
    condition: float
    rank: int

    @property
    def untold(self) -> tuple[Free, ...]:
        """Unknowns that these data do not tell, but for those that are known to be alike anyway."""
        pairs = zip(self.unknowns, self.learnt, strict=True)
        return tuple(unknown for unknown, part in pairs if part < _TOLD and unknown.tolerance is None)

    @property
    def entangled(self) -> tuple[tuple[Free, Free, float], ...]:
        """Pairs whose estimates hang together, with their correlation; without those within one batch."""
        pairs = []
        for i, one in enumerate(self.unknowns):
            for j in range(i):
                within_a_batch = one.tolerance is not None or self.unknowns[j].tolerance is not None
                if not within_a_batch and abs(self.correlation[i, j]) > _CORRELATED:
                    pairs.append((self.unknowns[j], one, float(self.correlation[i, j])))
        return tuple(pairs)


def identifiability(fitted: Fit) -> Identifiability:
    """Of a fit's shared unknowns."""
    spread = fitted.space.spread
    scaled = fitted.information * np.outer(spread, spread)  # the prior alone would be the identity
    covariance = np.linalg.inv(scaled)
    sd = np.sqrt(np.diag(covariance))
    of_data = np.linalg.eigvalsh(scaled - np.eye(spread.size))
    return Identifiability(
        fitted.space.unknowns,
        1 - sd,
        covariance / np.outer(sd, sd),
        float(np.sqrt(of_data[-1] / max(of_data[0], 1e-12 * of_data[-1]))) if of_data.size else 1.0,
        int(np.sum(of_data > 1)),
    )
