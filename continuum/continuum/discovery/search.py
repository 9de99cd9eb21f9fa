"""Round after round: try every effect on top of what was found, keep the best, until what is left is noise."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from continuum.discovery.evidence import DISTINCT, beyond_noise, explains_all, gain
from continuum.discovery.round import CONTENDING, ITERATIONS, Round, one_round
from continuum.discovery.trial import Trial
from continuum.discovery.workers import Make, Task

_BASELINE_ITERATIONS = 10
_MISLEADING = 0.1  # of the first effect's gain: a smaller second one has misled nobody
_ROUNDS = 3
_MUCH = 0.5  # of what the baseline does not explain
_MORE_THAN_THE_LAST = 5.0  # times what the last effect explained: hardly any later one explains so much


@dataclass(frozen=True)
class Earlier:
    """What a search found that took tensions for another way between rows: where this one may begin.

    Attributes:
        baseline: its fit without any effect.
        best: what it found, fitted to tensions as they are taken now.
    """

    baseline: Trial
    best: Trial


type Tell = Callable[[str, float], None]
"""Told what is going on and the part that is done, 0 to 1."""


def tell_nobody(_what: str, _part: float) -> None:
    """Keep it to oneself."""


type Until = Callable[[Trial], bool]
"""Asked after a round, of the best trial so far, whether there is no use in going on."""


def until_the_end(_best: Trial) -> bool:
    """Go on."""
    return False


def search(
    make: Make, effects: Sequence[str], tell: Tell, until: Until = until_the_end, earlier: Earlier | None = None
) -> tuple[Trial, list[Round]]:
    """The baseline and the rounds, one for each effect that was found; a last one may have found nothing.

    Args:
        make: makes trials.
        effects: names to try.
        tell: told of progress.
        until: asked after the first round, and after others that found something.
        earlier: of a search before this one.
    """
    tell("refitting the model as it is", 0.0)
    begun = None if earlier is None else earlier.baseline if earlier.best.extension else earlier.best
    (baseline,) = make([Task((), begun, _BASELINE_ITERATIONS)])
    rounds: list[Round] = []
    before, asked, may_stand_alone = baseline, None, True
    while True:
        known = earlier.best if earlier and not rounds else None
        rounds.append(one_round(make, before, effects, partial(tell, f"effects, round {len(rounds) + 1}"), known))
        if len(rounds) == 2 and _may_have_misled(rounds[1], rounds[0]):
            tell_of = partial(tell, "the first effect anew")
            rounds = _first_anew(make, rounds[0], rounds[1], effects, tell_of, may_stand_alone)
            may_stand_alone &= len(rounds) > 1
        if len(rounds) == 1:
            baseline = rounds[0].before
        best = rounds[-1].best
        if best.extension != asked and until(best):
            break
        if best is rounds[-1].before or explains_all(best) or len(rounds) == _ROUNDS or _is_in_vain(baseline, rounds):
            break
        before, asked = best, best.extension
    tell("effects sought", 1.0)
    return baseline, rounds


def _is_in_vain(baseline: Trial, rounds: Sequence[Round]) -> bool:
    """Whether so much is left that further effects would hardly explain it all.

    What helps most is found first: effects that come later hardly explain many times as much as the last one did.
    """
    left, more = beyond_noise(rounds[-1].best), _ROUNDS - len(rounds)
    latest = [one for one in rounds if len(one.best.extension) == len(rounds)]  # two where the first was sought anew
    if left > more * _MORE_THAN_THE_LAST * max(gain(one.best, one.before).log_likelihood for one in latest):
        return True
    return len(rounds) > 1 and left > _MUCH * beyond_noise(baseline)


def _may_have_misled(second: Round, first: Round) -> bool:
    """Whether the second effect is so large that the first may have stood for it, or hid which of several it is."""
    gained = [gain(one.best, one.before).log_likelihood for one in (second, first)]
    effect = first.best.extension[-1].effect
    others = [trial for trial in first.leaders if trial.extension[-1].effect != effect]
    is_contended = any(gain(trial, first.before).log_likelihood > CONTENDING * gained[1] for trial in others)
    return second.best is not second.before and (is_contended or gained[0] > _MISLEADING * gained[1])


def _first_anew(
    make: Make,
    first: Round,
    second: Round,
    effects: Sequence[str],
    tell: Callable[[float], None],
    may_stand_alone: bool,
) -> list[Round]:
    """The first effect sought once more, now beside the second: it was found while that one was still unknown.

    What then stands beside the second, and no other with it, may be a third one, which explains alone what the two do,
    and more than the first two: all are sought once more, and that one from as good a beginning.
    """
    alone = _newest_alone(make, second)
    again = one_round(make, alone, effects, tell)
    if again.best is again.before:  # the second one alone does it
        effect = alone.extension[-1].effect
        others = [trial for trial in first.leaders if trial.extension[-1].effect != effect]  # it is no rival of itself
        return [replace(first, leaders=(again.before, *others)), again]
    is_alone = all(gain(again.best, other).is_distinct for other in again.leaders[1:])
    if may_stand_alone and is_alone and again.best.extension[-1].effect != first.best.extension[-1].effect:
        newest = _newest_alone(make, again)
        if _does_as_well(newest, again.best) and gain(newest, second.best).is_distinct:
            anew = one_round(make, first.before, effects, tell, newest)
            if _does_as_well(anew.best, again.best):
                return [anew]
    return [second, again]


def _newest_alone(make: Make, one: Round) -> Trial:
    (alone,) = make([Task(one.best.extension[-1:], one.best, ITERATIONS)])
    return alone


def _does_as_well(trial: Trial, other: Trial) -> bool:
    return gain(other, trial).log_likelihood < DISTINCT
