"""Control of the step size, by the estimated errors of previous steps and by times at which a step has to end."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.integration.compiled_loops import compiled

FIRST_STEP = 1e-4  # [s]
_SAFETY, _GROWTH, _SHRINK = 0.9, 3.0, 0.2
_PROPORTIONAL, _INTEGRAL = 0.7, 0.3
_SMALL = 1e-4  # smaller errors, in units of the tolerance, carry no more information


@compiled
def error_size(step, weights, rates, x, new, relative, absolute):  # type: ignore[no-untyped-def]
    """Root mean square of the estimated error, step sum_i weights_i rates_i, in units of the tolerance."""
    total = 0.0
    for r in range(x.size):
        estimate = 0.0
        for i in range(weights.size):
            estimate += weights[i] * rates[i, r]
        total += (step * estimate / (absolute + relative * max(abs(x[r]), abs(new[r])))) ** 2
    return np.sqrt(total / x.size)


@compiled
def shorter(step, size, order):  # type: ignore[no-untyped-def]
    """Return the step to try after a refused one; ``size`` is not finite if its stages were not solved."""
    if not np.isfinite(size):
        return 0.25 * step
    return step * max(_SHRINK, _SAFETY * size ** (-1.0 / order))


@compiled
def longer(step, size, size_before, order, just_refused):  # type: ignore[no-untyped-def]
    """Return the next step by proportional-integral control (Gustafsson 1991), without growth after a refusal.

    Args:
        step: the accepted step [s].
        size, size_before: error sizes of this step and of the previous one.
        order: order of the method.
        just_refused: whether the step had to be repeated.
    """
    errors = max(size, _SMALL) ** -_PROPORTIONAL * max(size_before, _SMALL) ** _INTEGRAL
    most = 1.0 if just_refused else _GROWTH
    return step * min(most, max(_SHRINK, _SAFETY * errors ** (1.0 / order)))


@compiled
def step_towards(stop, t, wanted):  # type: ignore[no-untyped-def]
    """Return the length of a step, and whether it ends at ``stop``; avoids a tiny last step by two equal ones."""
    left = stop - t
    if wanted >= left * (1 - 1e-10):
        return left, True
    return min(wanted, 0.5 * left), False
