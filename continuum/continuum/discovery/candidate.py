"""A set of effects at its own optimum, with all that a decision needs to know of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array

type Key = tuple[tuple[str, tuple[int, ...] | None], ...]
"""Effects of a set and the joints at which each acts, from 0; None where it belongs to the whole arm."""


@dataclass(frozen=True)
class Candidate:
    """A set of effects.

    Attributes:
        effects: of the set; empty for the refitted baseline.
        log_evidence: at its own optimum.
        sigma: standard deviation of the missing torque that stays, root mean square of its posterior [N m].
        errors: of open-loop simulations, root mean square by run, (runs,) [rad]; NaN where one failed.
        free_form: by how much a torque of any form at any joint, or at all, raises the log-evidence.
    """

    effects: Key
    log_evidence: float
    sigma: float
    errors: Array
    free_form: float = 0.0

    @property
    def completed(self) -> bool:
        """Whether it can be simulated."""
        return bool(np.all(np.isfinite(self.errors)))
