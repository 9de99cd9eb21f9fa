"""What a campaign hides, case by case, in an order of which every beginning is balanced.

A round holds every effect of the library at each size, arms without any, effects outside of the library, and pairs;
every round has other arms, and moves datasets and noises on by one place. Where an effect begins is drawn by the
campaign's seed: the first rounds of several campaigns do not hide it in the same dataset each time.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np
from blind.plant import EFFECTS, LIBRARY, OUTSIDE, SIZES, Plan
from blind.plant.regimes import kinds

DATASETS = ("releases", "mixed", "driven", "slow", "fast")
EIGHT = "eight_releases"
NOISES = ("ordinary", "low", "ordinary", "high")
CLEAN_IN_A_ROUND = 2 * len(DATASETS)
PAIRS_IN_A_ROUND = len(DATASETS)
_PLACES = 60  # in turns of all lengths that occur
_MOST_IN_A_ROUND = _MOST_ROUNDS = 1000

CHOICES = ("clean", "one", "pairs", "outside", *LIBRARY, *OUTSIDE)
"""What a campaign may be narrowed to."""


def campaign(seed: int, rounds: int) -> Iterator[Plan]:
    """Plans of so many rounds; no two have the same seed."""
    for number in range(rounds):
        seeds = itertools.count(_MOST_IN_A_ROUND * (_MOST_ROUNDS * seed + number))
        yield from (Plan(*hidden, next(seeds), noise) for *hidden, noise in one_round(number, seed))


def campaign_of(plan: Plan) -> int:
    """Seed of the campaign that a plan is of."""
    return plan.seed // (_MOST_IN_A_ROUND * _MOST_ROUNDS)


def one_round(number: int, seed: int = 0) -> Iterator[tuple[tuple[str, ...], str, str, str]]:
    """Effects, size, dataset and noise of every case of a round, the number of which counts from 0."""
    begin = dict(zip(EFFECTS, np.random.default_rng(seed).integers(_PLACES, size=len(EFFECTS)).tolist(), strict=True))
    medium, large, small = (_every_effect(LIBRARY, size, number, begin) for size in ("medium", "large", "small"))
    yield from medium
    for i in range(CLEAN_IN_A_ROUND):
        yield (), "medium", DATASETS[i % len(DATASETS)], _turn(NOISES, i // len(DATASETS) + i + number)
    for name in OUTSIDE:
        yield from _every_effect([name], _turn(SIZES, begin[name] + number), number, begin)
    yield from large
    for i, dataset in enumerate(DATASETS):
        pair = _pair(dataset, np.random.default_rng([seed, number, i]))
        yield pair, _turn(("medium", "large"), number + i), dataset, _turn(NOISES, number + i)
    yield from small
    after_release = [name for name in LIBRARY if EFFECTS[name].seen_in & kinds(EIGHT)]
    yield (_turn(after_release, 5 * number),), "medium", EIGHT, "ordinary"


def narrowed(plans: Iterable[Plan], only: Sequence[str]) -> Iterator[Plan]:
    """Those of some of CHOICES; all where none is named."""
    return (plan for plan in plans if not only or {kind_of(plan.effects), *_alone(plan)} & set(only))


def kind_of(effects: Sequence[str]) -> str:
    """`clean`, `one`, `pairs` or `outside`."""
    if any(name in OUTSIDE for name in effects):
        return "outside"
    return ("clean", "one", "pairs")[len(effects)]


def _alone(plan: Plan) -> tuple[str, ...]:
    return plan.effects if len(plan.effects) == 1 else ()


def _every_effect(
    names: Sequence[str], size: str, number: int, begin: Mapping[str, int]
) -> Iterator[tuple[tuple[str, ...], str, str, str]]:
    """Each where it can be seen; the noise moves on when all datasets were had."""
    for name in names:
        shown = [dataset for dataset in DATASETS if EFFECTS[name].seen_in & kinds(dataset)]
        place = begin[name] + SIZES.index(size)
        yield (name,), size, _turn(shown, place + number), _turn(NOISES, place + number // len(shown))


def _pair(dataset: str, rng: np.random.Generator) -> tuple[str, ...]:
    shown = [name for name in LIBRARY if EFFECTS[name].seen_in & kinds(dataset)]
    return tuple(str(name) for name in rng.choice(shown, 2, replace=False))


def _turn[T](values: Sequence[T], place: int) -> T:
    return values[place % len(values)]
