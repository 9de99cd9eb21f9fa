"""From the rounds of a search to a verdict."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from continuum.discovery.evidence import DISTINCT, Gain, explains_all, gain, is_adequate, unexplained
from continuum.discovery.measured_gain import RunScore, closed_gap, is_far, is_open, is_vague
from continuum.discovery.round import Round
from continuum.discovery.trial import Trial
from continuum.discovery.verdict import Cause, Kind, Verdict
from continuum.dynamics.effect_lookup import effect_named

_LEAST_CLOSED = 1 / 3  # of the distance to the noise floor, by a cause; those that are right close half or more
_AWAY, _LEAST_OF_A_RUN = 4.0, 0.25  # noise floors, and what a run so far away comes nearer by; mostly by half or more
_WORSE = 1.05  # times the error without the extension
_MOST_CLOSED = 0.8  # of it, where windows stay unexplained, but most are explained
_ALL_CLOSED = 0.95  # of it, where it is the free runs alone that are explained
_MOST_LEFT = 1 / 3  # of the unexplained windows, where most is explained
_TELLING, _FEWEST = 2.0, 3  # noise floors, from which on a run is away; runs that tell a cause by themselves
_NOTICED = 0.05  # of it: less is no help
_OTHERS = 0.5  # of the best one's gain, beyond which another effect may be the one as well


def judge(baseline: Trial, rounds: Sequence[Round]) -> Verdict:
    """What can be said.

    Causes are the effects that were added round after round. They are named where nothing is left that noise
    does not explain; a model that is better and still wrong has an unknown cause, whatever helped it, unless no other
    effect comes near it and free runs tell that it is right (`confirmed`).
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
        to_close = _MOST_CLOSED if nearly else _ALL_CLOSED if alone else None
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


def confirmed(
    verdict: Verdict, before: Sequence[RunScore], after: Sequence[RunScore], beside: Sequence[RunScore] = ()
) -> Verdict:
    """The verdict, unless its model does not predict runs that were held out: then its cause is not the one.

    Windows as short as these are explained by what only looks like the cause, a free run is not: it comes nearer to the
    noise, where it was away from it, in every run that was far away, ends far off in none, and is worse in half of them
    at most. Where the model without it is adequate, nothing has to be explained, and that model it is; but no model is
    whose free runs end far from what was measured. What leaves windows unexplained is the cause nevertheless where free
    runs come to the noise, nearly where it explains most windows: where joints stick and slip a right model leaves some
    windows unexplained, begun a little wrong, but a wrong one hardly follows whole runs that it was not fitted to. The
    best other effect must not come there as well, and confidence is no more than the part that is closed.

    Args:
        verdict: of windows.
        before, after: free runs of the model without and with what is named.
        beside: of the model with the best other effect instead; none where there is none.
    """
    if verdict.to_close is not None and _comes_to_the_noise(before, after, verdict.to_close):
        if beside and closed_gap(before, beside) >= _MOST_CLOSED:
            return replace(verdict, to_close=None)
        closed = min(1.0, closed_gap(before, after))
        causes = tuple(replace(cause, confidence=closed * cause.confidence) for cause in verdict.causes)
        return replace(verdict, kind=Kind.CAUSE, causes=causes)
    if verdict.kind is Kind.ADEQUATE:
        if is_far(before):
            return replace(verdict, kind=Kind.UNKNOWN, predicts=False)
        return replace(verdict, vague=True) if is_vague(before) else verdict
    named = verdict.kind in (Kind.CAUSE, Kind.AMBIGUOUS)
    if not named:  # what helps in windows alone has not helped
        helps_nowhere = bool(verdict.causes) and is_open(before) and closed_gap(before, after) < _NOTICED
        return replace(verdict, predicts=False) if helps_nowhere else verdict
    if _bear_out(before, after):
        return verdict
    if is_adequate(verdict.baseline) and not is_far(before):
        share = verdict.unexplained[0], verdict.unexplained[0]
        best = verdict.baseline
        return Verdict(Kind.ADEQUATE, (), (), best, best, share, vague=is_vague(before))
    return replace(verdict, kind=Kind.UNKNOWN, alternatives=(), experiment="", predicts=False)


def contradicted(verdict: Verdict) -> Verdict:
    """The verdict where recordings contradict themselves: what an arm does of which they are not is unknown."""
    return replace(verdict, kind=Kind.UNKNOWN, alternatives=(), experiment="", vague=False, at_odds=True)


def _bear_out(before: Sequence[RunScore], after: Sequence[RunScore]) -> bool:
    """Whether free runs come nearer to the noise where there is a way to go, none ends far off, and few are worse."""
    worse = [a.position > _WORSE * max(b.position, b.floor) for b, a in zip(before, after, strict=True)]
    nearer = not is_open(before) or closed_gap(before, after) >= _LEAST_CLOSED
    nearer &= all(
        closed_gap([b], [a]) >= _LEAST_OF_A_RUN
        for b, a in zip(before, after, strict=True)
        if b.position > _AWAY * b.floor
    )
    return nearer and not is_far(after) and sum(worse) <= len(worse) / 2


def _comes_to_the_noise(before: Sequence[RunScore], after: Sequence[RunScore], least: float) -> bool:
    """Whether free runs come so near to the noise, also without any single run, and bear the cause out.

    One that comes below the noise does not pay for another. Where they have to come all the way it has to be one: of
    three runs or more most were away before, each of these comes most of it, and none ends away.
    """
    if not (_bear_out(before, after) and all(math.isfinite(score.position) for score in before)):
        return False
    after = [a if a.position > a.floor else replace(a, position=a.floor) for a in after]
    away = [(b, a) for b, a in zip(before, after, strict=True) if b.position > _TELLING * b.floor]
    if least >= _ALL_CLOSED and (
        len(before) < _FEWEST
        or len(away) <= len(before) / 2
        or any(closed_gap([b], [a]) < _MOST_CLOSED for b, a in away)
        or any(a.position > _TELLING * a.floor for a in after)
    ):
        return False
    pairs = list(zip(before, after, strict=True))
    parts = [pairs, *(pairs[:i] + pairs[i + 1 :] for i in range(len(pairs)) if len(pairs) > 1)]
    return all(closed_gap(*zip(*part, strict=True)) >= least for part in parts)


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
