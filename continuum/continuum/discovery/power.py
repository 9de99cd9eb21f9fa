"""Power: the smallest size of an effect that these recordings would have shown.

An effect of size theta in the arm would change the readings by theta S. A refit of the baseline absorbs a part of that;
the remainder, theta P S, raises the open-loop error of segment s from the noise sigma_s to
sqrt(sigma_s^2 + theta^2 a_s^2), where a_s is the root mean square of P S there. With N independent residuals, the
distribution of these errors is known (chi-square); errors of many repetitions are drawn and decided on as in a
diagnosis. S is the open-loop sensitivity to an effect whose size enters linearly; for any other, it is the change at
its typical size.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import log1p, sqrt
from typing import NamedTuple

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import mean_error
from continuum.discovery.decision import LEAST_SHARE, closed_share, noise_limit, price
from continuum.discovery.fit_result import Fitted
from continuum.discovery.hypotheses import PRIOR, Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.output_error import OutputError
from continuum.discovery.segment import Segment
from continuum.discovery.sensitivities import Sensitivities
from continuum.discovery.typical_size import typical_states

POWER = 0.8
"""Probability of being named at the stated size (Cohen, Statistical Power Analysis, 1988)."""
_SIZES = np.geomspace(1e-2, 30.0, 64)
"""Sizes to try, in typical ones, 14 % apart; these recordings do not test an effect that shows only beyond."""
_EVERY = 2  # one segment in so many is simulated with a nonlinear effect; the next are assumed to change as much
REFITS = 2  # most refits of the baseline to a change, each with the weights that the one before leaves
_SETTLED = 0.1  # relative change of the remainder below which refits end
_SMALL, _LARGE = 0.3, 4.0
"""Multiples of the typical size at which the baseline is refitted too: the one on the side where the answer lies."""
_REPEATS = 100
"""Number of repeated experiments: 80 % is then known to 4 %."""


@dataclass(frozen=True)
class Power:
    """Power to show one effect at one place.

    Attributes:
        hypothesis: effect and place.
        changes: root mean square change of the readings by its typical size, in units of the noise.
        tried: two multiples of the typical size, in rising order.
        left: remainders of these changes after a refit, divided by the multiple, (2, segments) [noise].
        noise: noise of each segment, (segments,) [rad].
        floor: open-loop error from the sensors' noise alone [rad].
        observations: number of independent residuals.
        values: number of its per-run values over all recordings.
    """

    hypothesis: Hypothesis
    changes: float
    tried: tuple[float, float]
    left: Array
    noise: Array
    floor: float
    observations: float
    values: int

    @property
    def kept(self) -> float:
        """Fraction of its change that remains after a refit of springs, friction and inertia, 0 to 1."""
        return _size(self._changed(1.0)) / self.changes if self.changes > 0 else 0.0

    def probability(self, size: float) -> float:
        """Return the probability of being named at a size, in units of the typical one."""
        chance = self._draws
        x, each = self._changed(size), self.observations / len(self.noise)
        with_effect = np.sqrt(np.maximum(chance.squares, 1e-12))
        without = np.sqrt(np.maximum(chance.squares + x**2 + 2 * x * chance.products / sqrt(each), 1e-12))
        errors, baseline = self.noise * with_effect, self.noise * without
        gain = np.mean(np.log(without) - np.log(with_effect), axis=1)
        occam = self.values * 0.5 * log1p(PRIOR**2 * self.observations * float(np.mean(x**2)) / max(self.values, 1))
        worth = gain * self.observations > price(1, occam)
        noise = errors * np.minimum(1.0, self.floor / mean_error(errors))[:, None]
        explains = closed_share(baseline, errors, noise)[1] > LEAST_SHARE
        is_seen = mean_error(baseline) > noise_limit(self.floor, self.observations)
        return float(np.mean(worth & explains & is_seen))

    def _changed(self, size: float) -> Array:
        """Return the remainder of a size after a refit with bounds, (segments,) [noise]; it never falls with size."""
        low, high = self.tried
        at_low = low * self.left[0]
        at_high = np.maximum(high * self.left[1], at_low)
        if size <= low:
            return np.asarray(size / low * at_low)
        if size >= high:
            return np.asarray(size / high * at_high)
        return np.asarray(at_low + (size - low) / (high - low) * (at_high - at_low))

    @cached_property
    def _draws(self) -> _Draws:
        """Random draws of repeated experiments, the same at all sizes."""
        random, each = np.random.default_rng(0), self.observations / len(self.noise)
        shape = (_REPEATS, len(self.noise))
        return _Draws(random.chisquare(each, shape) / each, random.standard_normal(shape))

    @cached_property
    def smallest(self) -> float:
        """Size from which it is named with probability POWER, in units of the typical one; infinite if none."""
        if not self.probability(_SIZES[-1]) >= POWER:
            return np.inf
        low, high = 0, len(_SIZES) - 1
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if self.probability(_SIZES[middle]) >= POWER else (middle, high)
        return float(_SIZES[high])


class _Draws(NamedTuple):
    """Squares of the noise over its variance, and its products with a change, (repeats, segments) each."""

    squares: Array
    products: Array


def powers(
    judge: OutputError,
    fit: Fitted,
    library: Library,
    about: Fitted | None = None,
    linear_only: bool = False,
    only: Collection[str] | None = None,
) -> list[Power]:
    """Return the power of each hypothesis; of several for one effect at one place, the greatest.

    Args:
        judge: output-error fits of the recordings.
        fit: fit of the set to which effects are added; the larger of its error and the sensors' counts as noise.
        library: library with the hypotheses.
        about: fit of the baseline, to which nonlinear effects are added; ``fit`` if None.
        only: labels of the hypotheses to evaluate; all if None.
        linear_only: whether to leave out effects whose size does not enter linearly: each of these takes simulations.
    """
    sensitivities = Sensitivities(judge, fit, library)
    if not sensitivities.completed:
        return []
    base, noise = fit if about is None else about, np.maximum(fit.errors, judge.floor)
    still = fit.unknowns.with_lists(
        [replace(one, mean=float(v)) for one, v in zip(fit.unknowns.common, fit.values.common, strict=True)],
        [[replace(one, mean=float(v)) for one, v in zip(those, values, strict=True)]
         for those, values in zip(fit.unknowns.per_run, fit.values.per_run, strict=True)],
    )  # fmt: skip
    values = replace(fit.values, local=tuple(np.zeros_like(one) for one in fit.values.local))

    def left(changed: Sequence[Segment]) -> Array:
        """Return the remainder of a change, root mean square by segment.

        Residuals of a wrong model count less, as they are correlated from row to row.
        """
        scale, stays = _with_noise(changed, sensitivities.segments), np.zeros(len(changed))
        for _ in range(REFITS):
            _, after = sensitivities.stepped(still, values, changed, scale)
            before, stays = stays, np.array([_size(one) for one in after]) / noise
            if abs(_size(stays) - _size(before)) <= _SETTLED * _size(stays):
                break
            both = zip(changed, after, strict=True)
            scale = _with_noise([one.with_residuals(r.ravel()) for one, r in both], sensitivities.segments)
        return stays

    def power(h: Hypothesis, changed: Sequence[Segment], every: int = 1) -> Power:
        changes = _size(np.array([_size(one.residuals) for one in changed]) / noise)

        def of_size(size: float) -> Array:
            found = left([one.with_residuals(size * one.residuals) for one in changed]) / size
            return np.repeat(found[::every], every)[: len(found)]

        def made(tried: tuple[float, float], of_sizes: Sequence[Array]) -> Power:
            count = h.local_sd.size * len(fit.values.per_run)
            return Power(h, changes, tried, np.array(of_sizes), noise, judge.floor, fit.observations, count)

        typical = of_size(1.0)
        if made((1.0, _LARGE), (typical, typical)).probability(1.0) < POWER:
            return made((1.0, _LARGE), (typical, of_size(_LARGE)))
        return made((_SMALL, 1.0), (of_size(_SMALL), typical))

    found = dict[object, Power]()
    for h in sensitivities.hypotheses:
        if not h.is_refit and (only is None or h.label in only):
            _keep(found, power(h, sensitivities.changes(h, h.sd / PRIOR, h.local_sd / PRIOR)))
    if linear_only:
        return list(found.values())
    here = judge.readings(base.state, base.values, _EVERY)
    for h, state in typical_states(judge.problem, base.state, library):
        there = judge.readings(state, base.values, _EVERY)
        changes = [
            np.zeros(one.readings.size) if before is None or after is None else (after - before).ravel()
            for one, before, after in zip(sensitivities.segments, here, there, strict=True)
        ]
        if all(np.all(np.isfinite(one)) for one in changes):
            both = zip(sensitivities.segments, changes, strict=True)
            _keep(found, power(h, [one.with_residuals(-change) for one, change in both], _EVERY))
    return list(found.values())


def _with_noise(changed: Sequence[Segment], fitted: Sequence[Segment]) -> list[Segment]:
    """Return segments whose residuals are a change plus those of a fit."""
    both = zip(changed, fitted, strict=True)
    return [one.with_residuals(one.residuals + other.residuals) for one, other in both]


def _keep(found: dict[object, Power], one: Power) -> None:
    if one.hypothesis.key not in found or found[one.hypothesis.key].smallest > one.smallest:
        found[one.hypothesis.key] = one


def _size(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
