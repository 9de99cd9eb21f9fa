"""Effects hidden in the data of two independent plants are found, and none that is not there.

Every effect of the library once in each plant, effects from outside of it, arms without any, and pairs; the diagnosis
is handed files only. What is not asked of each case is asked of all: `make bench-discovery` measures it. `make exam`
takes more seeds.
"""

import multiprocessing
import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor

import pytest

from blind.mujoco_plant import EFFECTS, LIBRARY, OUTSIDE
from blind.mujoco_plant.effect import DRIVEN, RELEASE
from tools.benchmarks.discovery.answer import Answer, answer, label
from tools.benchmarks.discovery.cases import run_case
from tools.benchmarks.discovery.plans import PLANTS, Plan
from tools.benchmarks.discovery.result import Result

FIRST_SEED = 8000
pytestmark = pytest.mark.hidden_effects

NOISES = ("low", "ordinary")
PAIRS = (("rest_angle", "joint_friction"), ("tip_payload", "sensor_delay"), ("angle_offset", "actuator_lag"))


def plans(rounds: int = 1) -> list[Plan]:
    """Medium size, two recordings: a release and a multisine, or two releases."""
    hidden: list[tuple[str, ...]] = [(name,) for name in (*LIBRARY, *OUTSIDE)]
    found = []
    for plant in PLANTS * rounds:
        for effects in [*hidden, (), (), *PAIRS]:
            seed = FIRST_SEED + len(found)
            alone = all(RELEASE in EFFECTS[name].seen_in for name in effects) and seed % 4 == 0
            regime = "releases" if alone else "mixed"
            found.append(Plan(plant, effects, "medium", regime, 2, NOISES[seed % 2], seed))
    return found


@pytest.fixture(scope="module")
def results(pytestconfig: pytest.Config) -> Iterator[list[Result]]:
    """Of all cases, one at a time for each core, each plant's arms in processes of their own."""
    cases = plans(pytestconfig.getoption("rounds"))
    with ProcessPoolExecutor(os.cpu_count(), multiprocessing.get_context("spawn")) as pool:
        yield list(pool.map(run_case, cases, [""] * len(cases)))


def judged(results: list[Result], *kinds: str) -> list[tuple[str, Answer]]:
    """What was hidden and said, and what that is worth."""
    return [(diagnostic(one), answer(one.hidden, one.verdict)) for one in results if one.plan.kind in kinds]


def diagnostic(one: Result) -> str:
    hidden = ", ".join(f"{e['name']}@{e['joint']}" for e in one.hidden) or "nothing"
    named = "" if one.verdict is None else "; ".join(label(s["effects"]) for s in one.verdict["sets"])
    return f"{one.plan}: hidden {hidden}, {one.verdict and one.verdict['verdict']} {named} {one.failure}"


def test_every_case_has_a_verdict(results: list[Result]) -> None:
    assert [diagnostic(one) for one in results if one.verdict is None] == []


def test_no_wrong_cause_is_named(results: list[Result]) -> None:
    worth = judged(results, "one", "pairs", "clean", "outside")
    assert [what for what, one in worth if one is Answer.WRONG_CAUSE] == []


def test_most_effects_are_named(results: list[Result]) -> None:
    """Of two recordings only; the others have to be `unknown` or too small to matter."""
    worth = judged(results, "one")
    missed = [f"{what}: {one.value}" for what, one in worth if one not in (Answer.RIGHT, Answer.SET)]
    assert len(missed) <= len(worth) // 2, "\n".join(missed)


def test_arms_without_an_effect_are_adequate(results: list[Result]) -> None:
    assert [what for what, one in judged(results, "clean") if one is not Answer.RIGHT] == []


def test_effects_that_no_library_has_are_unknown(results: list[Result]) -> None:
    assert [what for what, one in judged(results, "outside") if one not in (Answer.RIGHT, Answer.ADEQUATE)] == []


def test_pairs_are_named_at_least_in_part(results: list[Result]) -> None:
    worth = judged(results, "pairs")
    right = [what for what, one in worth if one in (Answer.RIGHT, Answer.SET, Answer.PART)]
    assert len(right) >= len(worth) // 2, "\n".join(what for what, _ in worth)


def test_every_effect_is_hidden_in_both_plants() -> None:
    for plant in PLANTS:
        hidden = {name for plan in plans() if plan.plant == plant for name in plan.effects}
        assert hidden == {*LIBRARY, *OUTSIDE}
    assert {DRIVEN in EFFECTS[name].seen_in for name in LIBRARY} == {True}
