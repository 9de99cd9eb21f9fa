"""Stated power, from the same arm without the effect, compared with the rate at which effects were found.

    python3 -m tools.benchmarks.discovery.power RESULTS.jsonl

Prints a line for each case of the held-out half in which one effect is hidden, and the means by plant and size.
"""

from __future__ import annotations

import sys
import tempfile
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

from blind import mujoco_plant

from continuum.discovery.power import Power, powers
from continuum.discovery.refit import refitted
from continuum.discovery.search import with_library
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model_file import load_model
from continuum.recordings.read_recording import read_recording
from tools.benchmarks.discovery.cases import MAKERS, MODEL
from tools.benchmarks.discovery.figures import FOUND, SAME
from tools.benchmarks.discovery.plans import HALVES, Plan
from tools.benchmarks.discovery.result import Result, load

_AMOUNTS: Final = SAME | {
    "angle_offset": {"offset": 1.0}, "gyro_drift": {"bias": 1.0}, "remounted_base": {"angle": 1.0},
}  # fmt: skip
"""The first one is the size; effects that are missing here have different measures in the plants and the library."""


class Predicted(NamedTuple):
    """Prediction for one case.

    Attributes:
        result: result of the diagnosis of the arm with the effect.
        probability: predicted probability of naming the effect, from the arm without it.
    """

    result: Result
    probability: float


def predicted(result: Result) -> Predicted | None:
    """Predict a case with one hidden effect; return None if its size has no equivalent in the library's unit."""
    plan = result.plan
    if len(result.hidden) != 1 or (size := _size(result.hidden[0])) is None:
        return None
    return Predicted(result, _probability(plan, result.hidden[0], size))


def _probability(plan: Plan, hidden: Mapping[str, Any], size: float) -> float:
    case = MAKERS[plan.plant]((), plan.size, plan.recordings, plan.seed, plan.noise)
    with tempfile.TemporaryDirectory() as folder:
        files = mujoco_plant.write_case(case, Path(folder) / "data")
        recordings = [read_recording(str(path)) for path in files]
    base, judge = refitted(recordings, load_model(MODEL))
    library = with_library(judge.problem, base.found).lin.library
    found = powers(judge, base.fit, library)
    return max((one.probability(size) for one in found if _is_it(one, hidden)), default=0.0)


def _is_it(one: Power, hidden: Mapping[str, Any]) -> bool:
    joints = one.hypothesis.joints
    where = (joints is None or len(joints) > 1) if hidden["joint"] is None else joints == (hidden["joint"] - 1,)
    return one.hypothesis.effect == hidden["name"] and where


def _size(hidden: Mapping[str, Any]) -> float | None:
    """Return the hidden size in units of the typical size, or None."""
    if hidden["name"] not in _AMOUNTS:
        return None
    parameter, factor = next(iter(_AMOUNTS[hidden["name"]].items()))
    typical = effect_named(hidden["name"]).parameters[parameter].typical or 1.0
    return abs(factor * float(hidden["amount"])) / typical


def table(found: Sequence[Predicted]) -> list[tuple[str, str, int, float, float]]:
    """Return rows of plant, size, number of cases, mean stated probability and fraction found."""
    groups: dict[tuple[str, str], list[Predicted]] = defaultdict(list)
    for one in found:
        for name in (one.result.plan.plant, "both"):
            groups[(name, one.result.plan.size)].append(one)
    return [
        (name, size, len(g), sum(x.probability for x in g) / len(g), sum(x.result.answer in FOUND for x in g) / len(g))
        for (name, size), g in sorted(groups.items())
    ]


def main(results: Path) -> None:
    found = list[Predicted]()
    for one in load(results):
        if one.plan.half == HALVES[1] and (case := predicted(one)) is not None:
            found.append(case)
            print(f"{case.probability:.2f} {one.answer.value}: {one.hidden[0]['name']}, {one.plan}", flush=True)
    for plant_name, size, n, stated, named in table(found):
        print(f"{plant_name}, {size}, {n} cases: {100 * stated:.0f} % stated, {100 * named:.0f} % found")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
