"""Free runs of held-out recordings bear a verdict out, or do not (step 8 of docs/discovery.md)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from continuum.discovery.evidence import is_adequate
from continuum.discovery.measured_gain import RunScore, closed_gap, is_far, is_open, is_vague
from continuum.discovery.verdict import Kind, Verdict

MOST_CLOSED, ALL_CLOSED = 0.8, 0.95
"""Parts of the distance to the noise that name a cause whose model leaves windows unexplained: the first where most of
them are explained, the second where it is the free runs alone that are."""
_LEAST_CLOSED = 1 / 3  # of the distance to the noise floor, by a cause; those that are right close half or more
_AWAY, _LEAST_OF_A_RUN = 4.0, 0.25  # noise floors, and what a run so far away comes nearer by; mostly by half or more
_WORSE = 1.05  # times the error without the extension
_NOTICED = 0.05  # of it: less is no help
_TELLING, _FEWEST = 2.0, 3  # noise floors, from which on a run is away; runs that tell a cause by themselves


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
        if beside and closed_gap(before, beside) >= MOST_CLOSED:
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
    if least >= ALL_CLOSED and (
        len(before) < _FEWEST
        or len(away) <= len(before) / 2
        or any(closed_gap([b], [a]) < MOST_CLOSED for b, a in away)
        or any(a.position > _TELLING * a.floor for a in after)
    ):
        return False
    pairs = list(zip(before, after, strict=True))
    parts = [pairs, *(pairs[:i] + pairs[i + 1 :] for i in range(len(pairs)) if len(pairs) > 1)]
    return all(closed_gap(*zip(*part, strict=True)) >= least for part in parts)
