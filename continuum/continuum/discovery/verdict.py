"""The answer to what a simulation gets wrong, as a typed value."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from continuum.discovery.candidate import Addition, Extension
from continuum.discovery.evidence import Gain
from continuum.discovery.trial import Trial


class Kind(Enum):
    """What can be said."""

    ADEQUATE = "adequate"
    CAUSE = "cause"
    AMBIGUOUS = "ambiguous"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Cause:
    """One effect that is named.

    Attributes:
        addition: the effect, and the joints where it acts.
        confidence: 0 to 1, that it is this one and no other of the library.
        gain: what it gains over the model without it.
        trial: the fit with it.
    """

    addition: Addition
    confidence: float
    gain: Gain
    trial: Trial


@dataclass(frozen=True)
class Verdict:
    """The answer.

    Attributes:
        kind: what can be said.
        causes: named effects; of AMBIGUOUS those of which one is at work; of UNKNOWN what helps but does not suffice.
        alternatives: of the last cause, effects that explain the data as well.
        baseline: the model refitted, without any effect.
        best: the best trial, whose extension the extended model has.
        unexplained: share of the data that stays unexplained before and after, 0 to 1.
        experiment: what to measure to tell alternatives apart, in words; empty where nothing is to be told apart.
        predicts: whether the best one's free runs come as near to what was held out as they should; if not, no cause is
            named, and no model is adequate.
        to_close: of causes that leave windows unexplained, and no other effect comes near: the part of the distance to
            the noise that free runs have to close for them to be named; None where no free run would do.
        vague: whether an ADEQUATE model's free runs end far from what was measured, as those of models do that the data
            do not tell from it.
        at_odds: whether the recordings contradict themselves, so that nothing fitted to them can be trusted.
    """

    kind: Kind
    causes: tuple[Cause, ...]
    alternatives: tuple[Cause, ...]
    baseline: Trial
    best: Trial
    unexplained: tuple[float, float]
    experiment: str = ""
    predicts: bool = True
    to_close: float | None = None
    vague: bool = False
    at_odds: bool = False

    @property
    def extension(self) -> Extension:
        """Effects of the extended model."""
        return self.best.extension
