"""How tensions go on between rows, asked again when a cause is known.

Tensions that are held where they are taken for linear, or the other way round, come half a row too early or too late:
in smooth tensions that looks like late sensors or slow actuators, and a model that is still wrong elsewhere may tell
the two ways apart wrongly at first. A cause that the other way makes needless is none; and with wrong rows further
effects are sought in vain, so that a search that found something asks before it goes on.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from continuum.discovery.candidate import Addition
from continuum.discovery.evidence import explains_all, gain, is_adequate
from continuum.discovery.likeliest_beginning import delays_of
from continuum.discovery.question import Question
from continuum.discovery.trial import Trial, fit_extension, judged
from continuum.dynamics.effect_lookup import effect_named
from continuum.identification.tension_rows import jumps_tell, turned


def with_better_rows(question: Question, best: Trial) -> tuple[Question, Trial] | None:
    """The question with tensions the other way between rows and its best trial so far, where that is better.

    None where it is not.

    Args:
        question: as it was asked, of runs of which some are driven.
        best: trial of a search that went so far.
    """
    if jumps_tell(question.recordings) or (not best.extension and is_adequate(best)):
        return None
    other = replace(question, recordings=tuple(turned(recording) for recording in question.recordings))
    late = [addition for addition in best.extension if effect_named(addition.effect).shifts_time]
    if late:
        needless = (some for count in range(len(late), 0, -1) for some in combinations(late, count))
        return next(((other, rest) for some in needless if (rest := _without(other, best, some))), None)
    trial = judged(best.extension, fit_extension(other, best.extension, best))
    if not gain(trial, best).is_significant:
        return None
    as_long = judged(best.extension, fit_extension(question, best.extension, best))  # longer fits find more
    return (other, trial) if gain(trial, as_long).is_significant else None


def _without(other: Question, best: Trial, some: Sequence[Addition]) -> Trial | None:
    """The trial without some effects, where tensions the other way do without them."""
    rest = tuple(addition for addition in best.extension if addition not in some)
    effects = [effect_named(addition.effect) for addition in rest]
    delays = {f"{effect.name}.{name}": size for effect in effects for name, size in delays_of(effect).items()}
    starts = [best, _half_a_row_off(other, best, delays)] if delays else [best]
    trials = [judged(rest, fit_extension(other, rest, start)) for start in starts]
    trial = min(trials, key=lambda one: one.cost)
    return trial if explains_all(trial) or not gain(best, trial).is_distinct else None


def _half_a_row_off(other: Question, best: Trial, delays: Mapping[str, float]) -> Trial:
    """The trial as a start, its delays less by what held tensions are late beside linear ones, or more.

    Delays, whose typical sizes are given [s], have a valley in every row: from half a row beside the right one no slope
    leads to it.
    """
    driven = [run.tensions for run in other.recordings if run.is_driven and run.tensions is not None]
    rows = [(-1 if tensions.held else 1) * float(np.median(np.diff(tensions.times))) for tensions in driven]
    coordinates = best.coordinates.copy()
    for i, unknown in enumerate(best.unknowns):
        if unknown.name in delays:
            coordinates[i] = max(coordinates[i] + np.median(rows) / 2 / delays[unknown.name], 0.0)
    return replace(best, coordinates=coordinates)
