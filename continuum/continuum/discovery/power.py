"""Power: how small an effect may be that these recordings would have shown.

An effect of size theta in the arm would change the readings by theta S. A refit of the baseline takes a part of that
away; what stays, theta P S, raises the open-loop error of segment s from the noise sigma_s to
sqrt(sigma_s^2 + theta^2 a_s^2), a_s the root mean square of P S there. Adding the effect would then gain, in
log-likelihood,

    L(theta) = N mean_s log(1 + theta^2 a_s^2 / sigma_s^2) / 2,      N independent residuals,

give or take sqrt(2 L) (noncentral chi-square). It is named where the gain is worth it (`is_worth`). S is the open-loop
sensitivity of an effect whose size enters linearly, and what its typical size changes of any other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, log1p, sqrt

import numpy as np
from scipy.optimize import brentq
from scipy.special import ndtr, ndtri

from continuum.arrays import Array
from continuum.discovery.decision import CHANCE, PRICE
from continuum.discovery.fitted import Fitted
from continuum.discovery.hypotheses import PRIOR, Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.open_loop import Segment
from continuum.discovery.output_error import OutputError
from continuum.discovery.sensitivities import Sensitivities
from continuum.discovery.typical import typical_states

POWER = 0.8
"""Probability of being named at the size that is stated (Cohen, Statistical Power Analysis, 1988)."""
_LEAST, _MOST = 1e-3, 30.0  # typical sizes: what only shows beyond that is not tested by these recordings


@dataclass(frozen=True)
class Power:
    """Of one effect at one place.

    Attributes:
        hypothesis: which.
        changes: root mean square change of the readings by its typical size, in units of the noise.
        left: what a refit leaves of that in each segment, (segments,) [noise].
        observations: residuals that are independent, their number.
        values: of it that each recording has for itself, their number.
    """

    hypothesis: Hypothesis
    changes: float
    left: Array
    observations: float
    values: int

    @property
    def kept(self) -> float:
        """Part of what it changes that a refit of springs, friction and inertia leaves, 0 to 1."""
        return _size(self.left) / self.changes if self.changes > 0 else 0.0

    def probability(self, size: float) -> float:
        """Of being named at a size in typical ones."""
        gain = self._gain(size)
        return float(ndtr((gain - self._cost(size)) / sqrt(2 * gain))) if gain > 0 else 0.0

    @property
    def smallest(self) -> float:
        """Size from which it is named with the probability POWER, in typical ones; infinite where there is none."""

        def excess(log_size: float) -> float:
            gain = self._gain(np.exp(log_size))
            return gain - float(ndtri(POWER)) * sqrt(2 * gain) - self._cost(np.exp(log_size))

        low, high = log(_LEAST), log(_MOST)
        if not excess(high) > 0:
            return np.inf
        return _LEAST if excess(low) > 0 else float(np.exp(brentq(excess, low, high)))

    def _gain(self, size: float) -> float:
        return 0.5 * self.observations * float(np.mean(np.log1p((size * self.left) ** 2)))

    def _cost(self, size: float) -> float:
        """Of the effect and of the values that each recording has for itself, Occam's factor [log-likelihood]."""
        per_value = self.observations * float(np.mean(self.left**2)) / max(self.values, 1)
        return PRICE - log(CHANCE) + self.values * 0.5 * log1p(PRIOR**2 * per_value) * (size > 0)


def powers(judge: OutputError, fit: Fitted, noise: Array, library: Library, about: Fitted | None = None) -> list[Power]:
    """Of each hypothesis; of those at one place and of one effect, the one that shows most.

    Args:
        judge: by which the set was fitted.
        fit: of the set about which effects are asked for.
        noise: in each segment [rad].
        library: with the hypotheses.
        about: fit of the baseline, from which what is not linear departs; the same without.
    """
    sensitivities = Sensitivities(judge, fit, library)
    if not sensitivities.completed:
        return []
    base = fit if about is None else about
    exact = sensitivities.residuals_after(fit.unknowns, fit.values, sensitivities.without_residuals())

    def power(h: Hypothesis, changed: Sequence[Segment]) -> Power:
        after = sensitivities.residuals_after(fit.unknowns, fit.values, changed)
        left = np.array([_size(one - other) for one, other in zip(after, exact, strict=True)]) / noise
        changes = _size(np.array([_size(one.slopes[:, -1]) for one in changed]) / noise)
        return Power(h, changes, left, fit.observations, h.local_sd.size * len(fit.values.own))

    found = dict[object, Power]()
    for h in sensitivities.hypotheses:
        if not h.is_refit:
            _keep(found, power(h, sensitivities.changes(h, h.sd / PRIOR, h.local_sd / PRIOR)))
    here = judge.readings(base.state, base.values)
    for h, state in typical_states(judge.problem, base.state, library):
        there = judge.readings(state, base.values)
        if all(np.all(np.isfinite(one)) for one in (*here, *there)):
            changes = [(after - before).ravel() for before, after in zip(here, there, strict=True)]
            both = zip(sensitivities.segments, changes, strict=True)
            _keep(found, power(h, [one.with_residuals(-change) for one, change in both]))
    return list(found.values())


def _keep(found: dict[object, Power], one: Power) -> None:
    if one.hypothesis.key not in found or found[one.hypothesis.key].smallest > one.smallest:
        found[one.hypothesis.key] = one


def _size(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
