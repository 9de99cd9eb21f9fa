"""Round after round: try every effect on top of what was found, keep the best, until what is left is noise.

A first look of a few iterations sorts out what does not help; only what leads is fitted to the end and found its
joints.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from continuum.discovery.candidate import Addition
from continuum.discovery.evidence import Gain, gain, is_adequate
from continuum.discovery.some_runs import carried
from continuum.discovery.trial import Trial
from continuum.discovery.workers import Make, Task, first_look

_LEADERS = 4
_ITERATIONS = 14
_BASELINE_ITERATIONS = 30
_ROUNDS = 3


@dataclass(frozen=True)
class Round:
    """One round.

    Attributes:
        before: the best trial of the round before.
        looks: every effect after its first look, best first.
        leaders: those fitted to the end, best first.
    """

    before: Trial
    looks: tuple[Trial, ...]
    leaders: tuple[Trial, ...]

    @property
    def best(self) -> Trial:
        """The best of all."""
        return self.leaders[0] if self.leaders and self.gain.is_significant else self.before

    @property
    def gain(self) -> Gain:
        """What the leader gains."""
        return gain(self.leaders[0], self.before)


type Tell = Callable[[str, float], None]
"""Told what is going on and the part that is done, 0 to 1."""


def tell_nobody(_what: str, _part: float) -> None:
    """Keep it to oneself."""


def search(make: Make, effects: Sequence[str], tell: Tell) -> tuple[Trial, list[Round]]:
    """The baseline and all rounds; the last one found nothing, or left nothing to find.

    Args:
        make: makes trials.
        effects: names to try.
        tell: told of progress.
    """
    tell("refitting the model as it is", 0.0)
    (baseline,) = make([Task((), None, _BASELINE_ITERATIONS)])
    rounds: list[Round] = []
    before = baseline
    while len(rounds) < _ROUNDS and not (rounds and is_adequate(before)):
        rounds.append(_round(make, before, effects, lambda part: tell(f"effects, round {len(rounds) + 1}", part)))
        if rounds[-1].best is before:
            break
        before = rounds[-1].best
    tell("done", 1.0)
    return baseline, rounds


def _round(make: Make, before: Trial, effects: Sequence[str], tell: Callable[[float], None]) -> Round:
    known = {addition.effect for addition in before.extension}
    extensions = [(*before.extension, Addition(effect)) for effect in effects if effect not in known]
    looks = []
    for trial in make([first_look(extension, before) for extension in extensions]):
        looks.append(trial)
        tell(0.6 * len(looks) / len(extensions))
    looks.sort(key=lambda trial: trial.cost)
    tasks = [Task(look.extension, carried(look, before), _ITERATIONS, True) for look in looks[:_LEADERS]]
    leaders = []
    for trial in make(tasks):
        leaders.append(trial)
        tell(0.6 + 0.4 * len(leaders) / len(tasks))
    leaders.sort(key=lambda trial: -gain(trial, before).log_likelihood)
    return Round(before, tuple(looks), tuple(leaders))
