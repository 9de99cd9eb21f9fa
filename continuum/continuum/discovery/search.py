"""Round after round: try every effect on top of what was found, keep the best, until what is left is noise.

A first look of a few iterations sorts out what does not help: friction makes the way to the best fit rugged, so that
what the slopes promise counts as well as what was gained; where they promise little for the first effect, the look is a
longer one. What leads is fitted to all data, and what then contends is fitted to the end and found its joints.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from continuum.discovery.candidate import Addition, Extension
from continuum.discovery.evidence import beyond_noise, explains_all, gain, is_adequate
from continuum.discovery.some_runs import carried
from continuum.discovery.trial import Trial
from continuum.discovery.window_beginnings import with_beginnings_of
from continuum.discovery.workers import FIRST_LOOK, LONG_LOOK, Make, Task, first_look
from continuum.identification.arrow_least_squares import FitStatus

_LEADERS = 5
_LEADING = 0.35  # of the best one's hope
_LITTLE = 0.1  # of what is left to explain: with no better hope, effects are looked at for longer
_HOPELESS = 4.0  # log-likelihood on half of the runs
_CONTENDING = 0.5  # of the best one's gain
_LEADER_ITERATIONS, _ITERATIONS, _BASELINE_ITERATIONS = 8, 12, 10
_ITERATIONS_ANEW = 4
_MISLEADING = 0.1  # of the first effect's gain: a smaller second one has misled nobody
_ROUNDS = 3
_MUCH = 0.5  # of what the baseline does not explain
_MORE_THAN_THE_LAST = 5.0  # times what the last effect explained: hardly any later one explains so much


@dataclass(frozen=True)
class Round:
    """One round.

    Attributes:
        before: the best trial of the round before, at its best.
        looks: every effect after its first look, the most promising first.
        leaders: those fitted to all data, of which the best were fitted to the end; those that help for sure first, the
            best of them before all; none where nothing promised anything.
    """

    before: Trial
    looks: tuple[Trial, ...]
    leaders: tuple[Trial, ...]

    @property
    def best(self) -> Trial:
        """The best of all."""
        return self.leaders[0] if self.leaders and gain(self.leaders[0], self.before).is_significant else self.before


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
    before, asked = baseline, None
    while True:
        known = earlier.best if earlier and not rounds else None
        rounds.append(_round(make, before, effects, partial(tell, f"effects, round {len(rounds) + 1}"), known))
        if len(rounds) == 1:
            baseline = rounds[0].before
        if len(rounds) == 2 and _may_have_misled(rounds[1], rounds[0]):
            rounds = _first_anew(make, rounds[0], rounds[1], effects, partial(tell, "the first effect anew"))
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
    is_contended = any(gain(trial, first.before).log_likelihood > _CONTENDING * gained[1] for trial in others)
    return second.best is not second.before and (is_contended or gained[0] > _MISLEADING * gained[1])


def _first_anew(
    make: Make, first: Round, second: Round, effects: Sequence[str], tell: Callable[[float], None]
) -> list[Round]:
    """The first effect sought once more, now beside the second: it was found while that one was still unknown."""
    (alone,) = make([Task(second.best.extension[-1:], second.best, _ITERATIONS)])
    again = _round(make, alone, effects, tell)
    if again.best is again.before:  # the second one alone does it
        effect = alone.extension[-1].effect
        others = [trial for trial in first.leaders if trial.extension[-1].effect != effect]  # it is no rival of itself
        return [replace(first, leaders=(again.before, *others)), again]
    return [second, again]


def _round(
    make: Make, before: Trial, effects: Sequence[str], tell: Callable[[float], None], earlier: Trial | None = None
) -> Round:
    known = {addition.effect for addition in before.extension}
    extensions = [before.extension, *((*before.extension, Addition(name)) for name in effects if name not in known)]
    without, looks = _looks(make, extensions, before, FIRST_LOOK, lambda part: tell(0.25 * part))
    if not (before.extension or is_adequate(before)) and _is_little(looks, without):
        without, looks = _looks(make, extensions, before, LONG_LOOK, lambda part: tell(0.25 + 0.25 * part))
    leading = [Task(look.extension, carried(look, before), _LEADER_ITERATIONS) for look in _leading(looks, without)]
    leaders = list(make(leading))
    tell(0.75)
    contenders = _contending(leaders, before)
    begun = [with_beginnings_of(trial, (before, *leaders)) for trial in contenders]
    ended = list(make([Task(trial.extension, trial, _ITERATIONS, True) for trial in begun]))
    ended += [trial for trial in leaders if all(trial is not one for one in contenders)]
    if earlier and earlier.extension:
        ended = _beside_an_earlier_one(make, before, ended, earlier)
    ended = sorted(ended, key=partial(_rank, before))
    if ended and gain(ended[0], before).is_significant:
        before = _as_well_fitted(make, before, ended[0])
    return Round(before, tuple(looks), tuple(ended))


def _beside_an_earlier_one(make: Make, before: Trial, ended: Sequence[Trial], earlier: Trial) -> list[Trial]:
    """The leaders of a round, and with them each effect of an earlier search's best, begun as there.

    That one was fitted for longer: what helps and has not come to its end goes on beside it, from its beginnings.
    """
    extensions = [(Addition(addition.effect),) for addition in earlier.extension]
    known = list(make([Task(extension, earlier, _LEADER_ITERATIONS + _ITERATIONS, True) for extension in extensions]))
    unended = [
        trial for trial in ended if trial.status is FitStatus.NO_CONVERGENCE and gain(trial, before).log_likelihood > 0
    ]
    begun = [with_beginnings_of(trial, known) for trial in unended]
    longer = list(make([Task(trial.extension, trial, _LEADER_ITERATIONS + _ITERATIONS, True) for trial in begun]))
    found: dict[str, Trial] = {}
    for trial in (*ended, *longer, *known):
        effect = trial.extension[-1].effect
        if effect not in found or gain(trial, found[effect]).log_likelihood > 0:
            found[effect] = trial
    return list(found.values())


def _looks(
    make: Make, extensions: Sequence[Extension], before: Trial, iterations: int, tell: Callable[[float], None]
) -> tuple[Trial, list[Trial]]:
    """What became of the model as it was, and of every effect added to it, the most promising first."""
    looks: list[Trial] = []
    for trial in make([first_look(extension, before, iterations) for extension in extensions]):
        looks.append(trial)
        tell(len(looks) / len(extensions))
    (without,) = [trial for trial in looks if trial.extension == before.extension]
    return without, sorted((trial for trial in looks if trial is not without), key=_hoped_for)


def _is_little(looks: Sequence[Trial], without: Trial) -> bool:
    """Whether the best hope is little beside what is left to explain."""
    left = without.cost - sum(float(run.sum()) for run in without.sizes) / 2
    return bool(looks) and _hoped_for(without) - _hoped_for(looks[0]) < _LITTLE * left


def _as_well_fitted(make: Make, before: Trial, best: Trial) -> Trial:
    """The round's beginning fitted once more, from where the best one ended: what a longer search found is no gain."""
    (again,) = make([Task(before.extension, best, _ITERATIONS_ANEW)])
    return again if again.cost < before.cost else before


def _hoped_for(look: Trial) -> float:
    """Cost that further iterations may reach."""
    return look.cost - look.promised


def _leading(looks: Sequence[Trial], without: Trial) -> list[Trial]:
    hopes = [without.cost - _hoped_for(look) for look in looks]
    least = max(_HOPELESS, _LEADING * max(hopes, default=0.0))
    return [look for look, hope in zip(looks, hopes, strict=True) if hope > least][:_LEADERS]


def _contending(leaders: Sequence[Trial], before: Trial) -> list[Trial]:
    """Those not far behind the best of those that help for sure, if any do: luck in one stretch hides none."""
    gains = [gain(trial, before) for trial in leaders]
    sure = [gained.log_likelihood for gained in gains if gained.is_significant]
    least = _CONTENDING * max(sure or [gained.log_likelihood for gained in gains], default=0.0)
    return [trial for trial, gained in zip(leaders, gains, strict=True) if gained.log_likelihood >= least]


def _rank(before: Trial, trial: Trial) -> tuple[bool, float]:
    gained = gain(trial, before)
    return not gained.is_significant, -gained.log_likelihood
