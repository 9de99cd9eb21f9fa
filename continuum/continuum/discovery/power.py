"""Power: the smallest size of each effect that these recordings would have shown.

An effect of size theta in the arm would change the readings by theta S. A refit of the baseline takes a part of that
away; what stays, theta P S, raises the open-loop error of segment s from the noise sigma_s to
sqrt(sigma_s^2 + theta^2 a_s^2), a_s the root mean square of P S there. Adding the effect would then gain, in
log-likelihood,

    L(theta) = N mean_s log(1 + theta^2 a_s^2 / sigma_s^2) / 2,      N independent residuals,

give or take sqrt(2 L) (noncentral chi-square). It is named where the gain is worth it (`is_worth`), so it is shown with
probability POWER from the size on at which L less z sqrt(2 L) is as much.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, log1p, sqrt

import numpy as np
from scipy.optimize import brentq
from scipy.special import ndtri

from continuum.arrays import Array
from continuum.discovery.decision import CHANCE, PRICE
from continuum.discovery.fitted import Fitted
from continuum.discovery.hypotheses import PRIOR, Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.output_error import OutputError
from continuum.discovery.sensitivities import Sensitivities

POWER = 0.8
"""Probability of being shown at the size that is stated (Cohen, Statistical Power Analysis, 1988)."""
_LEAST, _MOST = 1e-3, 30.0  # typical sizes: what only shows beyond that is not tested by these recordings
_CLOSE = 0.03  # of the logarithm of a size


@dataclass(frozen=True)
class Power:
    """Of one effect at one place.

    Attributes:
        hypothesis: which.
        size: smallest that would have been shown, in typical ones; infinite where none would.
        changes: root mean square change of the readings by a typical size, in units of the noise.
        left: part of that which a refit of springs, friction and inertia leaves.
    """

    hypothesis: Hypothesis
    size: float
    changes: float
    left: float


def powers(judge: OutputError, fit: Fitted, noise: Array, library: Library) -> list[Power]:
    """Of each hypothesis whose size enters linearly.

    Args:
        judge: by which the set was fitted.
        fit: of the set about which effects are asked for.
        noise: in each segment [rad].
        library: with the hypotheses.
    """
    about = Sensitivities(judge, fit, library)
    if not about.completed:
        return []
    nothing = about.residuals_after(fit.unknowns, fit.values, about.without_residuals())
    return [_power(about, fit, noise, nothing, h) for h in about.hypotheses]


def _power(about: Sensitivities, fit: Fitted, noise: Array, nothing: Sequence[Array], h: Hypothesis) -> Power:
    own = h.local_sd.size * len(fit.values.own)

    def changed(size: float) -> tuple[Array, Array]:
        """Of each segment in units of the noise, before and after a refit, which has bounds."""
        segments = about.changes(h, size * h.sd / PRIOR, size * h.local_sd / PRIOR)
        residuals = about.residuals_after(fit.unknowns, fit.values, segments)
        left = [_size(one - other) for one, other in zip(residuals, nothing, strict=True)]
        return np.array([_size(one.slopes[:, -1]) for one in segments]) / noise, np.array(left) / noise

    def excess(log_size: float) -> float:
        """Of what the effect would gain, less chance, over what it costs [log-likelihood]."""
        _, left = changed(float(np.exp(log_size)))
        gain = 0.5 * fit.observations * float(np.mean(np.log1p(left**2)))
        per_value = fit.observations * float(np.mean(left**2)) / max(own, 1) / np.exp(2 * log_size)
        occam = own * 0.5 * log1p(PRIOR**2 * per_value)
        return gain - float(ndtri(POWER)) * sqrt(2 * gain) - (PRICE + occam - log(CHANCE))

    changes, left = (_size(of_segments) for of_segments in changed(1.0))
    low, high = log(_LEAST), log(_MOST)
    if not excess(high) > 0:
        size = np.inf
    elif excess(low) > 0:
        size = _LEAST
    else:
        size = float(np.exp(brentq(excess, low, high, xtol=_CLOSE)))
    return Power(h, size, changes, left / changes if changes > 0 else 0.0)


def _size(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
