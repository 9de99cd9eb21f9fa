"""A question about half of the runs, and a trial of all of them as the start of one on these."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.discovery.question import Question
from continuum.discovery.trial import Trial
from continuum.identification.dataset import halves


def some_runs(question: Question, near: Trial) -> tuple[Question, Trial]:
    """The larger half, each kind of run with its share."""
    split = halves(question.recordings)
    half = max(split.identification, split.validation, key=len)
    chosen = [i for i, recording in enumerate(question.recordings) if any(recording is one for one in half)]
    number = {old: new for new, old in enumerate(chosen)}
    kept = [i for i, u in enumerate(near.unknowns) if u.recording is None or u.recording in number]
    ends = np.cumsum([0, *(run.size for run in near.held_out)])
    trial = replace(
        near,
        unknowns=tuple(
            replace(u, recording=None if u.recording is None else number[u.recording])
            for u in (near.unknowns[i] for i in kept)
        ),
        coordinates=near.coordinates[kept],
        amounts=near.amounts[kept],
        own=tuple(near.own[i] for run in chosen for i in range(ends[run], ends[run + 1])),
        held_out=tuple(near.held_out[run] for run in chosen),
        sizes=tuple(near.sizes[run] for run in chosen),
    )
    return replace(question, recordings=tuple(question.recordings[i] for i in chosen)), trial


def carried(look: Trial, before: Trial) -> Trial:
    """The start of a trial on all runs: what all share from a look at some, the rest from the trial before it."""
    shared = [i for i, unknown in enumerate(look.unknowns) if unknown.recording is None]
    rest = [i for i, unknown in enumerate(before.unknowns) if unknown.recording is not None]
    return replace(
        before,
        unknowns=(*(look.unknowns[i] for i in shared), *(before.unknowns[i] for i in rest)),
        coordinates=np.concatenate([look.coordinates[shared], before.coordinates[rest]]),
        amounts=np.concatenate([look.amounts[shared], before.amounts[rest]]),
    )
