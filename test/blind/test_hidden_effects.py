"""An effect hidden in the data is found, and never one that is not there: from files that tell nothing else."""

import os
import tempfile
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from blind.plant import DATASETS, LIBRARY, OUTSIDE, Truth, make_case, write_case
from tools.bench_discovery.answer import Answer, answer
from tools.bench_discovery.campaign import diagnosed

DEADLINE = 900.0  # s, of one diagnosis, on a machine that does other things too
DRIVEN = ("multisine", "hold_and_release", "steps")
SECONDS = 2.0  # of a driven recording


@dataclass(frozen=True)
class Hidden:
    """One case: effects at medium size in a small dataset, given by the regimes of its recordings."""

    effects: tuple[str, ...]
    regimes: tuple[str, ...]
    seed: int

    def diagnose(self) -> tuple[Truth, dict[str, Any]]:
        case = make_case(self.effects, "medium", self.regimes, self.seed, seconds=SECONDS)
        with tempfile.TemporaryDirectory() as folder:  # its name is by chance
            return case.truth, diagnosed(write_case(case, Path(folder) / "data"), DEADLINE)


CASES = {
    "rubbing_disc": Hidden(("rubbing_disc",), DATASETS["releases"], 62),
    "clean, releases": Hidden((), DATASETS["releases"], 68),
    "rest_angle": Hidden(("rest_angle",), DATASETS["releases"], 40),
    "sensor_scale": Hidden(("sensor_scale",), DATASETS["releases"], 60),
    "clean, driven": Hidden((), DRIVEN, 69),
    "tip_payload": Hidden(("tip_payload",), DATASETS["releases"], 44),
}
"""What takes longest first. `make bench-discovery` hides every effect, again and again."""

type Verdicts = dict[str, Future[tuple[Truth, dict[str, Any]]]]


@pytest.fixture(scope="module")
def verdicts(request: pytest.FixtureRequest) -> Iterator[Verdicts]:
    """Of the cases that are asked for, one at a time for each core."""
    chosen = [item.callspec.params["name"] for item in request.session.items if hasattr(item, "callspec")
              and item.path == request.path]  # fmt: skip
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield {name: pool.submit(CASES[name].diagnose) for name in chosen}
        pool.shutdown(cancel_futures=True)


@pytest.mark.parametrize("name", CASES)
def test_the_answer_fits_what_is_hidden(name: str, verdicts: Verdicts) -> None:
    """A library's effect is named, or in an ambiguous set; one outside of it is `unknown`; none is `adequate`.

    Of an effect of the whole arm some joints are enough here; the benchmark counts them apart.
    """
    truth, verdict = verdicts[name].result()
    given = answer(truth.plain()["effects"], verdict)
    told = f"{given.value}: hidden {shown(truth)}, verdict {verdict['verdict']} {named(verdict)}"
    good = (Answer.RIGHT, Answer.PART, Answer.SET) if truth.in_a_library else (Answer.RIGHT,)
    assert given in good, told


def test_cases_are_of_every_kind() -> None:
    hidden = [case.effects for case in CASES.values()]
    assert hidden.count(()) == 2
    for names in (LIBRARY, OUTSIDE):
        assert any(set(effects) & set(names) for effects in hidden)


def shown(truth: Truth) -> str:
    return ", ".join(f"{e.name}@{e.joint} {e.amount:.3g} {e.unit}" for e in truth.effects) or "nothing"


def named(verdict: dict[str, Any]) -> list[str]:
    return [
        f"{c['effect']}@{c['joints']} {c['confidence']:.2f}"
        for c in (*verdict["causes"], *verdict["alternatives"], *verdict["helps"])
    ]
