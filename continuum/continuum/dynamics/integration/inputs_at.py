"""Inputs at an instant, for compiled loops."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.integration.compiled_loops import compiled


@compiled
def inputs_at(begin, t, times, values, u):  # type: ignore[no-untyped-def]
    """Write into ``u`` the inputs at ``t``: linear between the rows, held before the first and after the last.

    ``begin`` is the start of the step that ``t`` is in: where two rows of one time make a jump, a step that ends there
    still has the inputs before it.
    """
    last = times.size - 1
    k = min(max(np.searchsorted(times, begin, side="right") - 1, 0), last)
    part = 0.0
    if k < last and t > times[k]:
        part = (t - times[k]) / (times[k + 1] - times[k])
    for j in range(values.shape[1]):
        u[j] = (1 - part) * values[k, j] + part * values[min(k + 1, last), j]


@compiled
def jumps_at(t, times):  # type: ignore[no-untyped-def]
    """Whether two rows have the time ``t``."""
    k = np.searchsorted(times, t, side="right") - 1
    return k > 0 and times[k] == t and times[k - 1] == t
