"""First states of windows improved one by one, parameters held: where a joint sticks in the data and slips in the model.

Such a window sits in a place of its own, from which slopes do not lead away. It is begun anew from what was measured, with
slow joints at rest, and from where the window before it ended.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from continuum.arrays import Array
from continuum.identification.arrow_least_squares import misfit_of
from continuum.identification.window_residual import Memory, WindowAt, WindowResidual

_BAD = 1.5  # misfit per error beyond which other beginnings are tried
_SLOW = 0.1  # rad/s; slower joints may be stuck
_STEPS = 8


def settled(run: WindowResidual, shared: Array, own: Sequence[Array], spread: Array) -> list[Array]:
    """Coordinates of each window's first state, none worse than before.

    Args:
        run: the recording.
        shared: coordinates of the shared unknowns, (k,).
        own: of each window, (2 n,).
        spread: prior standard deviation of the latter, (2 n,).
    """
    found: list[Array] = []
    memory = run.first_memory(shared, own[0])
    for window, mine in enumerate(own):
        at = run.window(window, shared, mine, memory)
        if at is None:
            return list(own)
        if misfit_of(at.part) > _BAD * at.part.errors.size:
            best = [at, *_descents(run, window, shared, mine, memory, spread)]
            at = min(best, key=lambda one: misfit_of(one.part) + float(np.sum((one.own / spread) ** 2)))
        memory = at.memory
        found.append(at.own)
    return found


def _descents(
    run: WindowResidual, window: int, shared: Array, mine: Array, memory: Memory, spread: Array
) -> Iterator[WindowAt]:
    """Where descents from several beginnings end."""
    for start in (mine, np.zeros(mine.size), run.still(window, _SLOW), run.still(window, 10 * _SLOW)):
        at = run.window(window, shared, start, memory)
        if at is not None:
            yield _descended(run, window, shared, at, memory, spread)


def _descended(
    run: WindowResidual, window: int, shared: Array, at: WindowAt, memory: Memory, spread: Array
) -> WindowAt:
    damping = 1e-2
    for _ in range(_STEPS):
        slopes, errors = at.part.by_own, at.part.errors
        square = slopes.T @ slopes + np.diag(spread**-2.0)
        pull = slopes.T @ errors + at.own / spread**2
        step = -np.linalg.solve(square + damping * np.diag(np.diag(square)), pull)
        there = run.window(window, shared, at.own + step, memory)
        if there is not None and misfit_of(there.part) < misfit_of(at.part):
            gain = misfit_of(at.part) - misfit_of(there.part)
            at, damping = there, max(0.1 * damping, 1e-6)
            if gain < 1.0:
                break
        else:
            damping *= 10
    return at
