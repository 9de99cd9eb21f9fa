"""Plans of a campaign, case by case, in an order that is balanced after any number of cases.

A round hides every effect of the library at each size once, and contains arms without any effect, effects outside of
the library, and pairs. Plant, regime, noise and number of recordings of a case are those that similar cases had least
often so far (minimisation: Pocock and Simon, Biometrics 31, 1975, 103-115).
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from blind.mujoco_plant import EFFECTS, LIBRARY, OUTSIDE, SIZES
from blind.mujoco_plant.effect import DRIVEN, RELEASE

PLANTS: Final = ("mujoco", "moreau")
NOISES: Final = ("low", "ordinary", "high")
REGIMES: Final = {
    "releases": (RELEASE,) * 8,
    "mixed": (RELEASE, "multisine", RELEASE, "hold_and_release", RELEASE, RELEASE, "steps", "reversals"),
    "driven": ("multisine", "hold_and_release", "steps", "reversals") * 2,
    "slow": ("ramp", "reversals", "ramp", "cocontraction") * 2,
    "fast": ("chirp", "steps", "multisine", "chirp") * 2,
}
"""Recordings of a dataset; a small dataset has the first four."""
KINDS: Final = ("one", "clean", "outside", "pairs")
HALVES: Final = ("development", "held-out")
ROUNDS: Final = 6
"""Of each half."""
CHOICES: Final = (*KINDS, *PLANTS, *SIZES, *REGIMES, *LIBRARY, *OUTSIDE)
"""Properties that can restrict a run."""
_CLEAN, _OUTSIDE, _PAIRS = 26, 10, 10
_RUNS = {8: 3.0, 4: 1.0}  # relative frequency of each number
_SEED = 3_000_000
_IN_A_ROUND = 1000  # seeds


@dataclass(frozen=True)
class Plan:
    """One case: plant, hidden effects and their size, regime, number of recordings, noise, and the seed of the rest."""

    plant: str
    effects: tuple[str, ...]
    size: str
    regime: str
    runs: int
    noise: str
    seed: int

    @property
    def kind(self) -> str:
        """Of KINDS."""
        if any(name in OUTSIDE for name in self.effects):
            return "outside"
        return ("clean", "one", "pairs")[len(self.effects)]

    @property
    def half(self) -> str:
        """Of HALVES."""
        return HALVES[(self.seed - _SEED) // _IN_A_ROUND % 2]

    @property
    def recordings(self) -> tuple[str, ...]:
        """Regimes of the recordings, as named by the plants."""
        return REGIMES[self.regime][: self.runs]

    def __str__(self) -> str:
        return f"{self.plant}, {self.size}, {self.runs} {self.regime}, noise {self.noise}, seed {self.seed}"


def campaign(half: str, rounds: int = ROUNDS) -> Iterator[Plan]:
    """Yield the plans of one half; no two plans of either half have the same seed."""
    which = HALVES.index(half)
    rng, had = np.random.default_rng([_SEED, which]), Counter[tuple[object, ...]]()
    for number in range(rounds):
        seeds = itertools.count(_SEED + _IN_A_ROUND * (2 * number + which))
        for effects, size in _hidden(number, rng):
            yield _least_had(effects, size, next(seeds), had, rng)


def narrowed(plans: Iterable[Plan], only: Sequence[str]) -> Iterator[Plan]:
    """Yield the plans with given kinds, plants, sizes, regimes or single hidden effects; other properties are free."""
    sorts = [set(only) & set(sort) for sort in (KINDS, PLANTS, SIZES, REGIMES, EFFECTS)]
    for plan in plans:
        alone = plan.effects[0] if len(plan.effects) == 1 else ""
        is_of = zip(sorts, (plan.kind, plan.plant, plan.size, plan.regime, alone), strict=True)
        if all(not wanted or mine in wanted for wanted, mine in is_of):
            yield plan


def shown_in(effects: Sequence[str]) -> list[str]:
    """Return the regimes that can show all of the effects."""
    kinds = {regime: {RELEASE if run == RELEASE else DRIVEN for run in runs} for regime, runs in REGIMES.items()}
    return [regime for regime in REGIMES if all(EFFECTS[name].seen_in & kinds[regime] for name in effects)]


def _hidden(number: int, rng: np.random.Generator) -> list[tuple[tuple[str, ...], str]]:
    """Return effects and size of every case of a round, with all kinds distributed evenly."""
    order = [str(name) for name in rng.permutation(LIBRARY)]
    outside = [((name,), SIZES[(i + turn) % 3]) for turn in range(3) for i, name in enumerate(OUTSIDE)]
    deck = [str(name) for _ in range(_PAIRS) for name in rng.choice(LIBRARY, 2, replace=False)]
    kinds: list[list[tuple[tuple[str, ...], str]]] = [
        [((name,), SIZES[(i + turn + number) % 3]) for turn in range(3) for i, name in enumerate(order)],
        [((), "medium")] * _CLEAN,
        [outside[(_OUTSIDE * number + i) % len(outside)] for i in range(_OUTSIDE)],
        [((deck[2 * i], deck[2 * i + 1]), SIZES[1 + (i + number) % 2]) for i in range(_PAIRS)],
    ]
    places = [((i + 0.5) / len(kind), one) for kind in kinds for i, one in enumerate(kind)]
    return [one for _, one in sorted(places, key=lambda place: place[0])]


def _least_had(
    effects: tuple[str, ...], size: str, seed: int, had: Counter[tuple[object, ...]], rng: np.random.Generator
) -> Plan:
    """Return the plan whose levels similar plans had least often so far."""
    levels = itertools.product(PLANTS, shown_in(effects), sorted(_RUNS), NOISES)
    options = [Plan(plant, effects, size, regime, runs, noise, seed) for plant, regime, runs, noise in levels]
    costs = np.array([sum(w * (had[mark] + 1) for mark, w in _marks(plan).items()) for plan in options])
    chosen = options[int(rng.choice(np.flatnonzero(costs < costs.min() + 1e-9)))]
    had.update(_marks(chosen).keys())
    return chosen


def _marks(plan: Plan) -> dict[tuple[object, ...], float]:
    """Return the counted levels of a plan, for equal effects, equal kind and size, and all plans, weighted.

    A level with a higher relative frequency counts less.
    """
    levels = ("plant", plan.plant), ("regime", plan.regime), ("noise", plan.noise), ("runs", plan.runs)
    groups = {("effects", plan.effects): 3.0, (plan.kind, plan.size): 1.0, ("all",): 1.0}
    marks: dict[tuple[object, ...], float] = {(*g, *level): w for g, w in groups.items() for level in levels}
    marks[plan.effects, plan.size, plan.plant] = 6.0
    marks |= {(plan.kind, *a, *b): 1.0 for a, b in itertools.combinations(levels, 2)}
    return {mark: w / _RUNS[plan.runs] if plan.runs in mark else w for mark, w in marks.items()}
