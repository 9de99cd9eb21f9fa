"""Where a fit that ended may begin once more, since it may have ended in a valley of its own.

Dry friction holds a joint in a range of angles, so that what moves its rest has several valleys. Of two effects that do
much the same, one that ended in a wrong valley has lost to the other by luck: each begins again with its effect half as
large again, windows as in its end and as measured; and with what all share, and every window, as in the best one's end.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from continuum.discovery.trial import Trial
from continuum.discovery.window_beginnings import begun_as

_LARGER = 1.5


def other_beginnings(trial: Trial, best: Trial) -> Iterator[Trial]:
    """Starts for another fit of the same extension; ``best`` is of the same round."""
    effect = trial.extension[-1].effect + "."
    mine = [i for i, unknown in enumerate(trial.unknowns) if unknown.name.startswith(effect)]
    larger = trial.coordinates.copy()
    larger[mine] *= _LARGER
    yield replace(trial, coordinates=larger)
    yield replace(trial, coordinates=larger, own=())
    if best is trial:
        return
    there, beside = dict(zip(best.unknowns, best.coordinates, strict=True)), trial.coordinates.copy()
    for i, unknown in enumerate(trial.unknowns):
        if i not in mine:
            beside[i] = there.get(unknown, beside[i])
    own = tuple(begun_as(*both) for both in zip(best.own, trial.own, strict=True))
    yield replace(trial, coordinates=beside, own=own)
