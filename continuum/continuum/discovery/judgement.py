"""From the rounds of a search to a verdict."""

from __future__ import annotations

import math
from collections.abc import Sequence

from continuum.discovery.confirmation import ALL_CLOSED, MOST_CLOSED
from continuum.discovery.evidence import DISTINCT, Gain, explains_all, gain, is_adequate, unexplained
from continuum.discovery.round import Round
from continuum.discovery.trial import Trial
from continuum.discovery.verdict import Cause, Kind, Verdict
from continuum.dynamics.effect_lookup import effect_named

_MOST_LEFT = 1 / 3  # of the unexplained windows, where most is explained
_OTHERS = 0.5  # of the best one's gain, beyond which another effect may be the one as well


def judge(baseline: Trial, rounds: Sequence[Round]) -> Verdict:
    """What can be said.

    Causes are the effects that were added round after round. They are named where nothing is left that noise
    does not explain; a model that is better and still wrong has an unknown cause, whatever helped it, unless no other
    effect comes near it and free runs tell that it is right (`continuum.discovery.confirmation.confirmed`).
    """
    added = [r for r in rounds if r.best is not r.before]
    if not added:
        share = unexplained(baseline), unexplained(baseline)
        kind = Kind.ADEQUATE if is_adequate(baseline) else Kind.UNKNOWN
        return Verdict(kind, (), (), baseline, baseline, share)
    complete = explains_all(added[-1].best)
    nearly = [] if complete else _those_that_explain_most(baseline, added)
    added = nearly or added
    best, causes = added[-1].best, tuple(_cause(r) for r in added)
    share = unexplained(baseline), unexplained(best)
    if not complete:
        alone = len(added) == 1 < len(rounds) and not _has_peers(added[0])  # and nothing more helps
        to_close = MOST_CLOSED if nearly else ALL_CLOSED if alone else None
        return Verdict(Kind.UNKNOWN, causes, (), baseline, best, share, to_close=to_close)
    named = {cause.addition.effect for cause in causes}  # beside each other they are no alternatives
    rivals = tuple(rival for r in added for rival in _rivals(r) if rival.addition.effect not in named)
    if rivals:
        effects = dict.fromkeys(c.addition.effect for c in (*causes, *rivals))
        experiment = " ".join(f"{effect}: {effect_named(effect).experiment}" for effect in effects)
        return Verdict(Kind.AMBIGUOUS, causes, rivals, baseline, best, share, experiment)
    return Verdict(Kind.CAUSE, causes, (), baseline, best, share)


def _those_that_explain_most(baseline: Trial, added: Sequence[Round]) -> list[Round]:
    """The first rounds, as few as explain most, where no other effect did nearly as well; none where there are none."""
    enough = _MOST_LEFT * unexplained(baseline)
    for count, one in enumerate(added, 1):
        if len(one.best.extension) != count:  # sought anew: this one stood beside an effect that a later round names
            continue
        if _has_peers(one):
            return []
        if unexplained(one.best) <= enough:
            return list(added[:count])
    return []


def _has_peers(one: Round) -> bool:
    """Whether another effect did nearly as well as the best one."""
    own = gain(one.best, one.before).log_likelihood
    others = [trial for trial in one.leaders if trial.extension[-1].effect != one.best.extension[-1].effect]
    return any(gain(trial, one.before).log_likelihood > _OTHERS * own for trial in others)


def _cause(one: Round) -> Cause:
    return Cause(one.best.extension[-1], _confidence(one, one.best), gain(one.best, one.before), one.best)


def _rivals(one: Round) -> list[Cause]:
    """Effects that explain as much as the best one does, and those that explain all and are not surely told from it."""
    others = [trial for trial in one.leaders[1:] if _may_be_instead(trial, gain(one.best, trial))]
    found = [Cause(t.extension[-1], _confidence(one, t), gain(t, one.before), t) for t in others]
    return [cause for cause in found if cause.gain.log_likelihood > 0]  # what is worse than nothing explains nothing


def _may_be_instead(trial: Trial, lead: Gain) -> bool:
    return not (lead.is_sure or (lead.is_distinct and not explains_all(trial)))


def _confidence(one: Round, trial: Trial) -> float:
    """Probability of a trial among the leaders: each one's gain over the best in units of how well it is known.

    What is not told apart differs by little more than by what its unknowns are free to follow.
    """
    weights = []
    for other in one.leaders:
        lead = gain(one.best, other)
        unit = max(1.0 if lead.is_distinct else DISTINCT, lead.deviation)
        weights.append(math.exp(-max(lead.log_likelihood, 0.0) / unit))
    return weights[one.leaders.index(trial)] / sum(weights) if trial in one.leaders else 0.0
