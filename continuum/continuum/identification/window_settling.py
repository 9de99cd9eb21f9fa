"""First states of windows found one by one, the parameters held.

Each window has a damping of its own, so that one in which a joint is about to slip does not hold up all others. Where a
joint sticks in the data and slips in the model, a window may sit in a place from which slopes do not lead away; such
a window is begun anew from what was measured, from there with slow joints at rest, and from where the window before it
ended: a joint that stuck there goes on to stick.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arrays import Array
from continuum.identification.arrow_least_squares import misfit_of
from continuum.identification.window_residual import Memory, WindowAt, WindowResidual

_BAD = 1.5  # squared errors, per error, beyond which other beginnings are tried
_SLOW = 0.1  # rad/s; slower joints may be stuck
_ENOUGH = 0.5  # of squared errors: a smaller expected gain is not worth a step
_ENOUGH_OF_BAD = 0.03  # the same, of squared errors that are not noise
_LEAST_DAMPING, _FELT = 1e-3, 0.1  # of a window's own unknowns; where a step was too long, one that is felt
_AS_EXPECTED = 0.5  # part of a step's expected gain, beyond which the next one may be longer
STEPS = 8
"""Most steps of a window for which its first state shall be found well."""


def descended(
    run: WindowResidual, shared: Array, own: Sequence[Array], anew: bool, steps: int = STEPS
) -> list[WindowAt] | None:
    """Every window near the best first state; None where the model cannot be simulated.

    Args:
        run: the recording.
        shared: coordinates of the shared unknowns, (k,).
        own: of each window's own unknowns, as `WindowAt.own`, to begin with.
        anew: try other beginnings for windows that stay bad.
        steps: at most, for each window.
    """
    found: list[WindowAt] = []
    memory: Memory | None = None
    for window, mine in enumerate(own):
        at = run.window(window, shared, mine, memory)
        if at is None:
            return None
        at = _descent(run, window, shared, at, memory, steps)
        if anew and at.part.errors @ at.part.errors > _BAD * at.part.errors.size:
            starts = [np.zeros(mine.size), run.still(window, _SLOW)]
            if found:
                starts.append(run.from_state(window, shared, found[-1].end))
            others = [_begun(run, window, shared, start, memory, steps) for start in starts]
            at = min((at, *(one for one in others if one is not None)), key=lambda one: _cost(run, window, one))
        memory = at.memory
        found.append(at)
    return found


def _begun(
    run: WindowResidual, window: int, shared: Array, start: Array, memory: Memory | None, steps: int
) -> WindowAt | None:
    """Where the descent from a beginning ends."""
    at = run.window(window, shared, start, memory)
    return None if at is None else _descent(run, window, shared, at, memory, steps)


def _descent(
    run: WindowResidual, window: int, shared: Array, at: WindowAt, memory: Memory | None, steps: int
) -> WindowAt:
    damping = _LEAST_DAMPING
    for _ in range(steps):
        slopes = at.part.by_own
        square = slopes.T @ slopes + np.diag(run.spreads[window] ** -2.0)
        pull = slopes.T @ at.part.errors + at.own / run.spreads[window] ** 2
        step = -np.linalg.solve(square + damping * np.diag(np.diag(square)), pull)
        bad = float(at.part.errors @ at.part.errors) - _BAD * at.part.errors.size
        if -pull @ step < max(_ENOUGH, _ENOUGH_OF_BAD * bad):
            break
        there = run.window(window, shared, at.own + step, memory)
        gained = -np.inf if there is None else _cost(run, window, at) - _cost(run, window, there)
        # of squared errors, by whose logarithm bad windows count: there next steps are longer only when bad no more
        expected = float(-2 * pull @ step - step @ square @ step)
        if there is not None and gained > 0:
            at = there
        damping *= 0.1 if gained > _AS_EXPECTED * expected else 1.0 if gained > 0 else 10.0
        damping = max(damping, _LEAST_DAMPING if gained > 0 else _FELT)
    return at


def _cost(run: WindowResidual, window: int, at: WindowAt) -> float:
    """Minus twice the logarithm of likelihood and prior."""
    return misfit_of(at.part) + float(np.sum((at.own / run.spreads[window]) ** 2))
