"""The whole answer: a diagnosis and its findings, in which no effect is named whose size may as well be none.

An effect may help by what it leaves open beside its size, such as the tension with which a run begins. Where no size of
an effect that is named is told from none by its interval, all is diagnosed again without that effect.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.discovery.diagnose import Diagnosis, diagnose
from continuum.discovery.findings import Findings, findings
from continuum.discovery.search import Tell, tell_nobody
from continuum.discovery.verdict import Kind
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model import Model
from continuum.errors import InvalidValueError
from continuum.identification.dataset import Dataset
from continuum.identification.noise import SensorKnowledge

_NEXT_TO_NONE = 1e-3  # of a typical size


def answer(
    dataset: Dataset,
    model: Model,
    seed: int = 0,
    processes: int | None = None,
    tell: Tell = tell_nobody,
    effects: Sequence[str] | None = None,
    known: SensorKnowledge | None = None,
) -> tuple[Diagnosis, Findings]:
    """Diagnose a model by data, and work out all that there is to tell.

    Args:
        dataset: runs of the arm.
        model: with nominal values.
        seed: of the intervals.
        processes: how many work at once; as many as there are cores without.
        tell: told of progress.
        effects: names of those to try; all that are installed without.
        known: of the sensors.

    Raises:
        InvalidValueError: a negative seed, and as of `continuum.discovery.diagnose.diagnose`.
    """
    if seed < 0:
        raise InvalidValueError("seed", seed, "0 or more")
    tried = list(effect_names() if effects is None else effects)
    left_out: list[str] = []
    while True:
        diagnosis = diagnose(dataset, model, known, processes=processes, tell=tell, effects=tried)
        tell("predicting runs that were held out", 1.0)
        found = findings(diagnosis, np.random.default_rng(seed))
        absent = absent_cause(found)
        if absent is None:
            return diagnosis, replace(found, notes=(*found.notes, *map(_told, left_out)))
        tell(f"once more without {absent}, which may as well be absent", 0.0)
        left_out.append(absent)
        tried.remove(absent)


def absent_cause(found: Findings) -> str | None:
    """An effect that is named, as cause or alternative, and of which no size is told from none: that of least gain.

    One at a time: where two hang together each may seem to be needless beside the other. Where it is ambiguous and a
    size of another one is told from none, none is left out: what helps without a size explains the data as well.
    """
    verdict = found.verdict
    if verdict.kind not in (Kind.CAUSE, Kind.AMBIGUOUS):
        return None
    told = {
        estimate.unknown.name.split(".")[0]
        for estimate in (*found.estimates, *(one for own in found.others for one in own))
        if "." in estimate.unknown.name and _is_there(estimate.unknown.name, estimate.low, estimate.high)
    }
    named = [*verdict.causes, *verdict.alternatives]
    absent = [cause for cause in named if cause.addition.effect not in told]
    if verdict.kind is Kind.AMBIGUOUS and len(absent) < len(named):
        return None
    least = min(absent, key=lambda cause: cause.gain.log_likelihood, default=None)
    return None if least is None else least.addition.effect


def _told(effect: str) -> str:
    return f"{effect} was left out: it helps, but its size may as well be none"


def _is_there(name: str, low: float, high: float) -> bool:
    """Whether an interval tells a size from none; what is no size only says what an effect looks like."""
    effect, parameter = name.split(".")
    meant = effect_named(effect).parameters[parameter]
    margin = _NEXT_TO_NONE * (meant.typical or 1.0)
    return meant.default == 0 and (low > margin or high < -margin)
