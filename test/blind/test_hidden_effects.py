"""An effect hidden in the data is found, and never one that is not there: from files that tell nothing else."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

import pytest

from blind.plant import DATASETS, LIBRARY, OUTSIDE, Truth, make_case, write_case
from tools.bench_discovery.answer import Answer, answer, label
from tools.bench_discovery.cases import diagnosed

DRIVEN = ("multisine", "hold_and_release", "steps")
SECONDS = 2.0  # of a driven recording


@dataclass(frozen=True)
class Hidden:
    """One case: effects at medium size in a small dataset, given by the regimes of its recordings."""

    effects: tuple[str, ...]
    regimes: tuple[str, ...]
    seed: int


CASES = {
    "rubbing_disc": Hidden(("rubbing_disc",), DATASETS["releases"], 62),
    "clean, releases": Hidden((), DATASETS["releases"], 68),
    "rest_angle": Hidden(("rest_angle",), DATASETS["releases"], 40),
    "sensor_scale": Hidden(("sensor_scale",), DATASETS["releases"], 60),
    "clean, driven": Hidden((), DRIVEN, 69),
    "tip_payload": Hidden(("tip_payload",), DATASETS["releases"], 44),
}
"""A few. `make bench-discovery` hides every effect, again and again."""


@pytest.mark.parametrize("name", CASES)
def test_the_answer_fits_what_is_hidden(name: str) -> None:
    """A library's effect is named, or in an ambiguous set; one outside of it is `unknown`; none is `adequate`.

    Of an effect of the whole arm some joints are enough here; the benchmark counts them apart.
    """
    hidden = CASES[name]
    case = make_case(hidden.effects, "medium", hidden.regimes, hidden.seed, seconds=SECONDS)
    with tempfile.TemporaryDirectory() as folder:  # its name is by chance
        verdict, _ = diagnosed(write_case(case, Path(folder) / "data"))
    given = answer(case.truth.plain()["effects"], verdict)
    named = "; ".join(label(one["effects"]) for one in verdict["sets"])
    told = f"{given.value}: hidden {shown(case.truth)}, verdict {verdict['verdict']} {named}"
    good = (Answer.RIGHT, Answer.PART, Answer.SET) if case.truth.in_a_library else (Answer.RIGHT,)
    assert given in good, told


def test_cases_are_of_every_kind() -> None:
    hidden = [case.effects for case in CASES.values()]
    assert hidden.count(()) == 2
    for names in (LIBRARY, OUTSIDE):
        assert any(set(effects) & set(names) for effects in hidden)


def shown(truth: Truth) -> str:
    return ", ".join(f"{e.name}@{e.joint} {e.amount:.3g} {e.unit}" for e in truth.effects) or "nothing"
