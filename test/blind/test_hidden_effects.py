"""An effect hidden in the data is found, and never one that is not there: from files that tell nothing else."""

from pathlib import Path
from typing import Any

import pytest

from blind.plant import DATASETS, EFFECTS, LIBRARY, OUTSIDE, Truth, make_case, write_case
from blind.plant.regimes import kinds
from tools.bench_discovery.answer import Answer, answer
from tools.bench_discovery.campaign import diagnosed

DEADLINE = 900.0  # s, on a machine that does other things too
SEED = 40  # of the first effect; every one has an arm of its own
DRIVEN = ("multisine", "hold_and_release", "steps")
SECONDS = 2.0  # of a driven recording

KNOWN_MISSES: dict[str, str] = {}
"""What is not found, by effect, or "clean, DATASET", and why; a wrong cause fails all the same."""


def cases() -> list[Any]:
    """Every effect once, at medium size in a small dataset that can show it; and two arms without any."""
    hidden = [(name, seed, (name,), small_dataset(name)) for seed, name in enumerate(EFFECTS, SEED)]
    hidden += [
        (f"clean, {dataset}", seed, (), regimes)
        for seed, (dataset, regimes) in enumerate({"releases": DATASETS["releases"], "driven": DRIVEN}.items(), 80)
    ]
    return [pytest.param(name, effects, seed, regimes, id=name) for name, seed, effects, regimes in hidden]


def small_dataset(effect: str) -> tuple[str, ...]:
    """Four releases where these can show the effect, else three driven recordings."""
    return DATASETS["releases"] if EFFECTS[effect].seen_in & kinds("releases") else DRIVEN


@pytest.mark.parametrize(("name", "effects", "seed", "regimes"), cases())
def test_the_answer_fits_what_is_hidden(
    name: str, effects: tuple[str, ...], seed: int, regimes: tuple[str, ...], tmp_path: Path
) -> None:
    """A library's effect is named, or in an ambiguous set; one outside of it is `unknown`; none is `adequate`."""
    case = make_case(effects, "medium", regimes, seed, seconds=SECONDS)
    verdict = diagnosed(write_case(case, tmp_path / "data"), DEADLINE)
    given = answer(case.truth.plain()["effects"], verdict)
    told = f"{given.value}: hidden {shown(case.truth)}, verdict {verdict['verdict']} {named(verdict)}"
    assert given not in (Answer.WRONG_CAUSE, Answer.WRONG_JOINT), told  # never, known misses included
    good = (Answer.RIGHT, Answer.SET) if case.truth.in_a_library else (Answer.RIGHT,)
    if given not in good and name in KNOWN_MISSES:
        pytest.xfail(f"{KNOWN_MISSES[name]}; {told}")
    assert given in good, told


def test_every_effect_is_hidden_once() -> None:
    hidden = [name for case in cases() for name in case.values[1]]
    assert sorted(hidden) == sorted((*LIBRARY, *OUTSIDE))
    assert {*KNOWN_MISSES} <= {case.id for case in cases()}


def shown(truth: Truth) -> str:
    return ", ".join(f"{e.name}@{e.joint} {e.amount:.3g} {e.unit}" for e in truth.effects) or "nothing"


def named(verdict: dict[str, Any]) -> list[str]:
    return [
        f"{c['effect']}@{c['joints']} {c['confidence']:.2f}" for c in (*verdict["causes"], *verdict["alternatives"])
    ]
