"""Simulate the next run or manual measurement that a diagnosis proposes, and check whether it separates the causes.

    python3 -m tools.benchmarks.discovery.next_experiment OUT.jsonl [CASES [PART PARTS]]

The cases are the ambiguous ones of the benchmark; with several processes each one takes a part.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Sequence, Set
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from blind import moreau_plant, mujoco_plant
from blind.mujoco_plant.further_run import Wanted, further_run

from continuum.discovery import diagnose
from continuum.discovery.decision import Kind
from continuum.discovery.designs import Design, designs
from continuum.discovery.experiments import rival_of
from continuum.discovery.hand_measurement import HandMeasurement
from continuum.discovery.result import Cause, Diagnosis, Experiment, HandTest, Removal, is_named
from continuum.discovery.verdict_json import as_mapping
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model_file import load_model
from continuum.recordings.read_recording import read_recording
from tools.benchmarks.discovery.answer import is_exactly
from tools.benchmarks.discovery.cases import MAKERS, MODEL
from tools.benchmarks.discovery.figures import SAME
from tools.benchmarks.discovery.plans import Plan
from tools.benchmarks.discovery.result import load

RESULTS = Path("data/discovery_benchmark.jsonl")


@dataclass(frozen=True)
class Separation:
    """Result of one case.

    Attributes:
        plan: plan of the case.
        before, after: labels of the possible sets.
        experiment: proposed run, measured value or effect to remove; the best run if there was no proposal.
        runs: number of proposed runs, 0 if no separation is expected (one is made anyway); 1 for a measurement.
        separated: whether the likeliest set and its rival are no longer both possible, and the true one was not lost.
        kept: whether the true set, if it was possible before, is still possible or named.
    """

    plan: str
    before: list[str]
    after: list[str]
    experiment: str
    runs: int
    separated: bool
    kept: bool


def separation(plan: Plan) -> Separation | None:
    """Diagnose, make the proposed run, and diagnose again; return None if the first diagnosis is not ambiguous."""
    case = MAKERS[plan.plant](plan.effects, plan.size, plan.recordings, plan.seed, plan.noise)
    model, hidden = load_model(MODEL), list(case.truth.plain()["effects"])  # type: ignore[call-overload]
    with tempfile.TemporaryDirectory() as folder:
        files = mujoco_plant.write_case(case, Path(folder) / "data")
        recordings = [read_recording(str(path)) for path in files]
        first, measured, zeroed = diagnose(recordings, model), list[HandMeasurement](), list[int]()
        if len(first.sets) < 2 or first.verdict.kind.value != "ambiguous" or not first.experiments:
            return None
        best = first.separating or first.experiments[0]
        taken_off = set[tuple[str, int | None]]()
        if isinstance(best, Removal):
            left = tuple(name for name in plan.effects if name != best.effect)
            again = MAKERS[plan.plant](left, plan.size, plan.recordings, plan.seed, plan.noise)
            recordings = [read_recording(str(path)) for path in mujoco_plant.write_case(again, Path(folder) / "again")]
            taken_off = {(best.effect, None)}
        elif isinstance(best, HandTest):
            measured.append(_measured(best, hidden, np.random.default_rng(plan.seed)))
        else:
            design = next(one for one in designs(model, recordings) if one.name == best.name)
            for number in range(max(best.runs, 1)):
                further = Path(folder) / "data" / f"further_{number + 1}.csv"
                further.write_bytes(_made(plan, case.truth, design, number))
                recordings.append(read_recording(str(further)))
                zeroed += [len(recordings) - 1] * design.zeroed
        without = [name for name, _ in taken_off]
        second = diagnose(recordings, model, with_power=False, measured=measured, zeroed=zeroed, without=without)
    known = taken_off | {(one.effect, one.joint) for one in measured if not one.is_none}
    rivals = [_without(causes, known) for causes in _rivals(first)]
    both = all(rival in _answers(second) for rival in rivals)
    left = [one for one in hidden if (one["name"], one["joint"] and one["joint"] - 1) not in known]
    kept = not _holds(first, hidden) or _holds(second, left) or _holds(second, hidden)
    runs = best.runs if isinstance(best, Experiment) else 1
    name = best.effect if isinstance(best, Removal) else best.name
    return Separation(str(plan), _labels(first), _labels(second), name, runs, kept and not both, kept)


def _made(plan: Plan, truth: mujoco_plant.case.Truth, design: Design, number: int) -> bytes:
    driven = bool((design.inputs.values > 0).any())
    bend = None if driven else float(design.posture.sum())
    wanted = Wanted(bend, design.inputs.values if driven else None, design.zeroed)
    if plan.plant == "moreau":
        noises, steps = moreau_plant.case.NOISES, moreau_plant.machine.STEPS
        return further_run(truth, wanted, number, moreau_plant.Machine, noises, rates=False, steps=steps)
    return further_run(truth, wanted, number)


def _measured(test: HandTest, hidden: list[dict[str, Any]], random: np.random.Generator) -> HandMeasurement:
    """Return a value of the plant with the error of the usual instrument."""
    factor = SAME[test.effect][test.parameter]
    at = None if test.joint is None else test.joint + 1
    found = [one for one in hidden if one["name"] == test.effect and one["joint"] in (None, at)]
    true = sum(factor * one["amount"] for one in found)
    spec = effect_named(test.effect).parameters[test.parameter]
    value = float(np.clip(true + test.sd * random.standard_normal(), spec.lower, spec.upper))
    return HandMeasurement(test.effect, test.parameter, test.joint, value, test.sd)


def _rivals(result: Diagnosis) -> list[tuple[Cause, ...]]:
    """Return the likeliest set and the likeliest one with other effects, which an experiment must separate."""
    other = rival_of([{cause.effect for cause in causes} for causes in result.sets])
    return [result.sets[0], *([] if other is None else [result.sets[other]])]


def _without(causes: Sequence[Cause], known: Set[tuple[str, int | None]]) -> frozenset[str]:
    """Return the labels of a set's effects except the measured ones."""
    places = [
        (one.effect, one.joints[0] if one.joints is not None and len(one.joints) == 1 else None) for one in causes
    ]
    return frozenset(one.label for one, place in zip(causes, places, strict=True) if place not in known)


def _answers(result: Diagnosis) -> list[frozenset[str]]:
    """Return the possible sets; for an adequate model, the empty set."""
    if result.verdict.kind is Kind.ADEQUATE:
        return [frozenset()]
    return [frozenset(one.label for one in causes) for causes in result.sets if is_named(result.verdict.kind)]


def _labels(result: Diagnosis) -> list[str]:
    return [" + ".join(sorted(one)) or "nothing" for one in _answers(result)]


def _holds(result: Diagnosis, hidden: list[dict[str, Any]]) -> bool:
    if result.verdict.kind is Kind.ADEQUATE:
        return not hidden
    return any(is_exactly(hidden, one["effects"]) for one in as_mapping(result)["sets"])


def main(out: Path, cases: int, part: int, parts: int) -> None:
    seen = [one.plan for one in load(RESULTS) if one.verdict and one.verdict["verdict"] == "ambiguous"]
    plans = list({plan.seed: plan for plan in seen}.values())[part - 1 :: parts]
    found = list[Separation]()
    for plan in plans:
        if len(found) == cases:
            break
        if (one := separation(plan)) is not None:
            found.append(one)
            with out.open("a", encoding="utf-8") as file:
                file.write(json.dumps(asdict(one)) + "\n")
            print(f"{len(found)}. {'separated' if one.separated else 'not separated'}: {one}", flush=True)
    separated, kept = sum(one.separated for one in found), sum(one.kept for one in found)
    print(f"separated: {separated} of {len(found)}; true set kept: {kept}")


if __name__ == "__main__":
    of = [int(text) for text in sys.argv[2:]]
    main(Path(sys.argv[1]), *(of[:1] or [30]), *(of[1:3] or [1, 1]))
