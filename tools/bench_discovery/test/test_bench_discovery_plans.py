"""Plans are the same each time, and every beginning is balanced."""

from __future__ import annotations

from collections import Counter

import pytest
from blind.plant import EFFECTS, LIBRARY, OUTSIDE, SIZES
from blind.plant.effect import DRIVEN

from tools.bench_discovery.plans import HALVES, NOISES, PLANTS, REGIMES, campaign, narrowed, shown_in

DEVELOPMENT, HELD_OUT = (list(campaign(half)) for half in HALVES)
PLANS = [*DEVELOPMENT, *HELD_OUT]
ROUND = len(list(campaign("held-out", 1)))


def test_seeds_are_the_same_each_time_and_of_one_half_alone() -> None:
    assert list(campaign("development", 1)) == DEVELOPMENT[:ROUND]
    assert len({plan.seed for plan in PLANS}) == len(PLANS)
    assert {plan.half for plan in DEVELOPMENT} == {"development"}
    assert {plan.half for plan in HELD_OUT} == {"held-out"}


def test_there_are_enough_cases() -> None:
    kinds = Counter(plan.kind for plan in PLANS)
    assert len(PLANS) >= 1200
    assert kinds["clean"] >= 300
    assert min(kinds["outside"], kinds["pairs"]) >= 100


def test_effects_are_hidden_only_where_they_can_be_seen() -> None:
    assert "releases" not in shown_in(["capstan"])
    assert all(EFFECTS[name].seen_in & {DRIVEN} for plan in PLANS if plan.regime != "releases" for name in plan.effects)
    assert all(plan.regime in shown_in(plan.effects) for plan in PLANS)


def test_a_round_has_every_effect_at_every_size() -> None:
    found = Counter((plan.effects[0], plan.size) for plan in HELD_OUT[:ROUND] if plan.kind == "one")
    assert found == {(name, size): 1 for name in LIBRARY for size in SIZES}
    assert {name for plan in HELD_OUT[: 2 * ROUND] if plan.kind == "outside" for name in plan.effects} == set(OUTSIDE)


@pytest.mark.parametrize("plans", [DEVELOPMENT, HELD_OUT], ids=HALVES)
def test_every_beginning_is_balanced(plans: list) -> None:
    for end in range(40, len(plans), 25):
        begun = plans[:end]
        for what, values in (("plant", PLANTS), ("regime", list(REGIMES)), ("noise", NOISES)):
            counts = Counter(getattr(plan, what) for plan in begun)
            assert max(counts.values()) - min(counts[value] for value in values) <= 4
        kinds = Counter(plan.kind for plan in begun)
        assert all(abs(kinds[kind] / end - n / ROUND) < 0.05 for kind, n in KINDS_OF_A_ROUND.items())
        hidden = Counter(plan.effects for plan in begun if plan.kind == "one")
        assert max(hidden.values()) - min(hidden[name,] for name in LIBRARY) <= 1
        assert 0.15 < sum(plan.runs == 4 for plan in begun) / end < 0.35


KINDS_OF_A_ROUND = Counter(plan.kind for plan in HELD_OUT[:ROUND])


@pytest.mark.parametrize("name", LIBRARY)
def test_an_effect_meets_all_levels(name: str) -> None:
    mine = [plan for plan in HELD_OUT if plan.effects == (name,)]
    assert {(plan.size, plan.plant) for plan in mine} == {(size, plant) for size in SIZES for plant in PLANTS}
    assert {plan.regime for plan in mine} == set(shown_in([name]))
    assert {plan.noise for plan in mine} == set(NOISES)


def test_a_campaign_may_be_narrowed() -> None:
    assert list(narrowed(PLANS, [])) == PLANS
    assert {plan.kind for plan in narrowed(PLANS, ["clean", "pairs"])} == {"clean", "pairs"}
    some = list(narrowed(PLANS, ["capstan", "backlash", "moreau", "large"]))
    assert {plan.effects for plan in some} == {("capstan",), ("backlash",)}
    assert {(plan.plant, plan.size) for plan in some} == {("moreau", "large")}


def test_small_datasets_have_the_first_recordings() -> None:
    assert {len(plan.recordings) for plan in PLANS} == {4, 8}
    assert all(plan.recordings == REGIMES[plan.regime][: plan.runs] for plan in PLANS)
