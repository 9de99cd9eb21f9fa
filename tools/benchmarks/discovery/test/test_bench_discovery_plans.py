"""Plans are the same each time, and every beginning is balanced."""

from __future__ import annotations

from collections import Counter
from functools import cache

import pytest
from blind.mujoco_plant import EFFECTS, LIBRARY, OUTSIDE, SIZES
from blind.mujoco_plant.effect import DRIVEN

from tools.benchmarks.discovery.plans import HALVES, NOISES, PLANTS, REGIMES, Plan, campaign, narrowed, shown_in


@cache
def planned(half: str, rounds: int | None = None) -> list[Plan]:
    """Not at import, which other tests wait for."""
    return list(campaign(half) if rounds is None else campaign(half, rounds))


@pytest.fixture(scope="module")
def plans() -> list[Plan]:
    """Of both halves."""
    return [plan for half in HALVES for plan in planned(half)]


@pytest.fixture(scope="module")
def a_round() -> list[Plan]:
    return planned("held-out", 1)


def test_seeds_are_the_same_each_time_and_of_one_half_alone(plans: list[Plan]) -> None:
    assert list(campaign("development", 1)) == planned("development")[: len(planned("development", 1))]
    assert len({plan.seed for plan in plans}) == len(plans)
    for half in HALVES:
        assert {plan.half for plan in planned(half)} == {half}


def test_effects_are_hidden_only_where_they_can_be_seen(plans: list[Plan]) -> None:
    assert "releases" not in shown_in(["capstan"])
    assert all(EFFECTS[name].seen_in & {DRIVEN} for plan in plans if plan.regime != "releases" for name in plan.effects)
    assert all(plan.regime in shown_in(plan.effects) for plan in plans)


def test_a_round_has_every_effect_at_every_size(a_round: list[Plan]) -> None:
    found = Counter((plan.effects[0], plan.size) for plan in a_round if plan.kind == "one")
    assert found == {(name, size): 1 for name in LIBRARY for size in SIZES}
    assert {
        name for plan in planned("held-out")[: 2 * len(a_round)] if plan.kind == "outside" for name in plan.effects
    } == set(OUTSIDE)


@pytest.mark.parametrize("half", HALVES)
def test_every_beginning_is_balanced(half: str, a_round: list[Plan]) -> None:
    of_a_round = Counter(plan.kind for plan in a_round)
    for end in range(40, len(planned(half)), 25):
        begun = planned(half)[:end]
        for what, values in (("plant", PLANTS), ("regime", list(REGIMES)), ("noise", NOISES)):
            counts = Counter(getattr(plan, what) for plan in begun)
            assert max(counts.values()) - min(counts[value] for value in values) <= 4
        kinds = Counter(plan.kind for plan in begun)
        assert all(abs(kinds[kind] / end - n / len(a_round)) < 0.05 for kind, n in of_a_round.items())
        hidden = Counter(plan.effects for plan in begun if plan.kind == "one")
        assert max(hidden.values()) - min(hidden[name,] for name in LIBRARY) <= 1
        assert 0.15 < sum(plan.runs == 4 for plan in begun) / end < 0.35


@pytest.mark.parametrize("name", LIBRARY)
def test_an_effect_meets_all_levels(name: str) -> None:
    mine = [plan for plan in planned("held-out") if plan.effects == (name,)]
    assert {(plan.size, plan.plant) for plan in mine} == {(size, plant) for size in SIZES for plant in PLANTS}
    assert {plan.regime for plan in mine} == set(shown_in([name]))
    assert {plan.noise for plan in mine} == set(NOISES)


def test_a_campaign_may_be_narrowed(plans: list[Plan]) -> None:
    assert list(narrowed(plans, [])) == plans
    assert {plan.kind for plan in narrowed(plans, ["clean", "pairs"])} == {"clean", "pairs"}
    some = list(narrowed(plans, ["capstan", "backlash", "moreau", "large"]))
    assert {plan.effects for plan in some} == {("capstan",), ("backlash",)}
    assert {(plan.plant, plan.size) for plan in some} == {("moreau", "large")}
