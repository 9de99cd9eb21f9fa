"""One round of the search: every effect tried on top of what was found, the best of them at their best.

A first look of a few iterations sorts out what does not help: friction makes the way to the best fit rugged, so that
what the slopes promise counts as well as what was gained; where they promise little for the first effect, the look is a
longer one. What leads is fitted to all data, and what then contends is fitted to the end and found its joints; where
several do, each once more from other beginnings.

Where the model without any effect is very wrong, its windows begin in places from which no slope leads to the right
one: looks and leaders then begin theirs as measured, and so does that model once more.

Where joints stick and slip, short looks may lead nowhere, too: a first effect that explains little is sought once more
by close looks, and of each effect the better trial stays.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from continuum.discovery.candidate import Addition
from continuum.discovery.evidence import beyond_noise, gain, is_adequate, unexplained
from continuum.discovery.other_beginnings import other_beginnings
from continuum.discovery.some_runs import carried
from continuum.discovery.special_cases import without_special_cases
from continuum.discovery.trial import Trial
from continuum.discovery.window_beginnings import with_beginnings_of
from continuum.discovery.workers import FIRST_LOOK, LONG_LOOK, Make, Task, first_look
from continuum.identification.arrow_least_squares import FitStatus

_LEADERS = 5
_LEADING = 0.35  # of the best one's hope
_LITTLE = 0.1  # of what is left to explain: with no better hope, effects are looked at for longer
_VERY_WRONG = 0.5  # of windows unexplained
_MUCH = 0.5  # of what there is to explain
_HOPELESS = 4.0  # log-likelihood on half of the runs
CONTENDING = 0.5
"""Part of the best one's gain, beyond which another may be the one as well."""
_LEADER_ITERATIONS, ITERATIONS = 8, 12
_ITERATIONS_ANEW = 4


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


def one_round(
    make: Make, before: Trial, effects: Sequence[str], tell: Callable[[float], None], earlier: Trial | None = None
) -> Round:
    """One round.

    Args:
        make: makes trials.
        before: the best trial of the round before.
        effects: names to try beside those of ``before``.
        tell: told of the part that is done, 0 to 1.
        earlier: the best of an earlier search, where this is the first round of another.
    """
    afresh = not before.extension and unexplained(before) > _VERY_WRONG
    found = _round(make, before, effects, tell, earlier, afresh)
    if before.extension or is_adequate(found.before) or _explains_much(found):
        return found
    closer = _round(make, found.before, effects, tell, earlier, closely=True)
    leaders = without_special_cases(_one_of_each((*found.leaders, *closer.leaders)))
    return replace(closer, leaders=tuple(sorted(leaders, key=partial(_rank, closer.before))))


def _explains_much(found: Round) -> bool:
    return beyond_noise(found.best) < _MUCH * beyond_noise(found.before)


def _round(
    make: Make,
    before: Trial,
    effects: Sequence[str],
    tell: Callable[[float], None],
    earlier: Trial | None,
    afresh: bool = False,
    closely: bool = False,
) -> Round:
    """One round, with looks as of `Task`."""
    known = {addition.effect for addition in before.extension}
    extensions = [before.extension, *((*before.extension, Addition(name)) for name in effects if name not in known)]
    iterations = LONG_LOOK if closely else FIRST_LOOK
    first = [first_look(extension, before, iterations, afresh, closely) for extension in extensions]
    without, looks = _looks(make, first, before, lambda part: tell(0.25 * part))
    if not (closely or before.extension or is_adequate(before)) and _is_little(looks, without):
        longer = [first_look(extension, before, LONG_LOOK, afresh) for extension in extensions]
        without, looks = _looks(make, longer, before, lambda part: tell(0.25 + 0.25 * part))
    leading = [
        Task(look.extension, carried(look, before), _LEADER_ITERATIONS, afresh=afresh)
        for look in _leading(looks, without)
    ]
    leaders = list(make(leading))
    tell(0.75)
    if afresh:  # what they gain by that alone is no gain
        (other,) = make([Task((), before, _LEADER_ITERATIONS, afresh=True)])
        before = other if other.cost < before.cost else before
    contenders = _contending(leaders, before)
    begun = [with_beginnings_of(trial, (before, *leaders)) for trial in contenders]
    ended = list(make([Task(trial.extension, trial, ITERATIONS, True) for trial in begun]))
    ended += [trial for trial in leaders if all(trial is not one for one in contenders)]
    if earlier and earlier.extension:
        ended = _beside_an_earlier_one(make, before, ended, earlier)
    ended = sorted(without_special_cases(_begun_otherwise(make, before, ended)), key=partial(_rank, before))
    if ended and gain(ended[0], before).is_significant:
        before = _as_well_fitted(make, before, ended[0])
    return Round(before, tuple(looks), tuple(ended))


def _beside_an_earlier_one(make: Make, before: Trial, ended: Sequence[Trial], earlier: Trial) -> list[Trial]:
    """The leaders of a round, and with them each effect of an earlier search's best, begun as there.

    That one was fitted for longer: what helps and has not come to its end goes on beside it, from its beginnings.
    """
    extensions = [(Addition(addition.effect),) for addition in earlier.extension]
    known = list(make([Task(extension, earlier, _LEADER_ITERATIONS + ITERATIONS, True) for extension in extensions]))
    unended = [
        trial for trial in ended if trial.status is FitStatus.NO_CONVERGENCE and gain(trial, before).log_likelihood > 0
    ]
    begun = [with_beginnings_of(trial, known) for trial in unended]
    longer = list(make([Task(trial.extension, trial, _LEADER_ITERATIONS + ITERATIONS, True) for trial in begun]))
    return _one_of_each((*ended, *longer, *known))


def _one_of_each(trials: Sequence[Trial]) -> list[Trial]:
    """The best trial of each last effect."""
    found: dict[str, Trial] = {}
    for trial in trials:
        effect = trial.extension[-1].effect
        if effect not in found or gain(trial, found[effect]).log_likelihood > 0:
            found[effect] = trial
    return list(found.values())


def _looks(
    make: Make, tasks: Sequence[Task], before: Trial, tell: Callable[[float], None]
) -> tuple[Trial, list[Trial]]:
    """What became of the model as it was, and of every effect added to it, the most promising first."""
    looks: list[Trial] = []
    for trial in make(tasks):
        looks.append(trial)
        tell(len(looks) / len(tasks))
    (without,) = [trial for trial in looks if trial.extension == before.extension]
    return without, sorted((trial for trial in looks if trial is not without), key=_hoped_for)


def _is_little(looks: Sequence[Trial], without: Trial) -> bool:
    """Whether the best hope is little beside what is left to explain."""
    left = without.cost - sum(float(run.sum()) for run in without.sizes) / 2
    return bool(looks) and _hoped_for(without) - _hoped_for(looks[0]) < _LITTLE * left


def _begun_otherwise(make: Make, before: Trial, ended: Sequence[Trial]) -> list[Trial]:
    """The same, those that contend with each other as good as from any of several beginnings."""
    contenders = _contending(ended, before)
    if len(contenders) < 2:  # the only one need not be better to lead
        return list(ended)
    best = max(contenders, key=lambda trial: gain(trial, before).log_likelihood)
    starts = [(trial, start) for trial in contenders for start in other_beginnings(trial, best)]
    again = list(make([Task(trial.extension, start, ITERATIONS) for trial, start in starts]))
    return [
        min((trial, *(one for one in again if one.extension == trial.extension)), key=lambda one: one.cost)
        for trial in ended
    ]


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
    most = max(sure or [gained.log_likelihood for gained in gains], default=0.0)
    least = min(CONTENDING * most, most)  # of those behind it, too, the best may come to lead
    return [trial for trial, gained in zip(leaders, gains, strict=True) if gained.log_likelihood >= least]


def _rank(before: Trial, trial: Trial) -> tuple[bool, float]:
    gained = gain(trial, before)
    return not gained.is_significant, -gained.log_likelihood
