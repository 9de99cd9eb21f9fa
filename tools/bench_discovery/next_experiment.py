"""The next run or measurement by hand that a diagnosis proposes, made in simulation: does it separate the causes?

    python3 -m tools.bench_discovery.next_experiment OUT.jsonl [CASES]

Cases are those of the benchmark that were ambiguous.
"""

from __future__ import annotations

import json
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from blind import moreau, plant
from blind.plant.further import Wanted, further_run

from continuum.cli.diagnose import read_recording
from continuum.discovery import diagnose
from continuum.discovery.designs import Design, designs
from continuum.discovery.experiments import rival_of
from continuum.discovery.hand_measurement import HandMeasurement, zeros_set
from continuum.discovery.result import Diagnosis, Experiment, HandTest
from continuum.discovery.verdict_json import as_mapping
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model_file import load_model
from tools.bench_discovery.answer import is_exactly
from tools.bench_discovery.cases import MAKERS, MODEL
from tools.bench_discovery.figures import SAME
from tools.bench_discovery.plans import Plan
from tools.bench_discovery.result import load

RESULTS = Path("data/discovery_benchmark.jsonl")


@dataclass(frozen=True)
class Separation:
    """Of one case.

    Attributes:
        plan: of the case.
        before, after: verdict and labels of its sets.
        experiment: run or measured value that was proposed and made; the best run where none was proposed.
        runs: of it that were proposed, 0 where it is not expected to separate; one is made then. 1 of a measurement.
        is_assumed: whether a value was measured whose effect is hidden and has another measure in the plant: what the
            set with that effect says is taken then.
        separated: whether the likeliest set and its rival are no longer both possible.
        kept: whether the true set, where it was possible, still is, or is named.
    """

    plan: str
    before: list[str]
    after: list[str]
    experiment: str
    runs: int
    is_assumed: bool
    separated: bool
    kept: bool


def separation(plan: Plan) -> Separation | None:
    """Diagnose, make the proposed run, diagnose again; None where the first diagnosis is not ambiguous."""
    case = MAKERS[plan.plant](plan.effects, plan.size, plan.recordings, plan.seed, plan.noise)
    model, hidden = load_model(MODEL), list(case.truth.plain()["effects"])  # type: ignore[call-overload]
    with tempfile.TemporaryDirectory() as folder:
        files = plant.write_case(case, Path(folder) / "data")
        recordings = [read_recording(str(path)) for path in files]
        first, measured, is_assumed = diagnose(recordings, model), list[HandMeasurement](), False
        if len(first.sets) < 2 or first.verdict.kind.value != "ambiguous" or not first.experiments:
            return None
        best = first.separating or first.experiments[0]
        if isinstance(best, HandTest):
            measurement, is_assumed = _measured(first, best, hidden, np.random.default_rng(plan.seed))
            measured.append(measurement)
        else:
            design = next(one for one in designs(model, recordings) if one.name == best.name)
            for number in range(max(best.runs, 1)):
                further = Path(folder) / "data" / f"further_{number + 1}.csv"
                further.write_bytes(_made(plan, case.truth, design, number))
                recordings.append(read_recording(str(further)))
                measured += zeros_set(recordings[-1].name, model.n_joints) if design.zeroed else []
        second = diagnose(recordings, model, with_power=False, measured=measured)
    before, after = _labels(first), _labels(second)
    both = set(_rivals(first)) <= set(after)
    return Separation(
        str(plan), before, after, best.name, best.runs if isinstance(best, Experiment) else 1, is_assumed,
        not both and bool(second.verdict.sets),
        not _holds(first, hidden) or _holds(second, hidden),
    )  # fmt: skip


def _made(plan: Plan, truth: plant.case.Truth, design: Design, number: int) -> bytes:
    driven = bool((design.inputs.values > 0).any())
    bend = None if driven else float(design.posture.sum())
    wanted = Wanted(bend, design.inputs.values if driven else None, design.zeroed)
    if plan.plant == "moreau":
        noises, steps = moreau.case.NOISES, moreau.machine.STEPS
        return further_run(truth, wanted, number, moreau.Machine, noises, rates=False, steps=steps)
    return further_run(truth, wanted, number)


def _measured(
    first: Diagnosis, test: HandTest, hidden: list[dict[str, Any]], random: np.random.Generator
) -> tuple[HandMeasurement, bool]:
    """A value of the plant as the usual instrument shows it, and whether it had to be assumed."""
    found = [one for one in hidden if one["name"] == test.effect]
    factor = SAME.get(test.effect, {}).get(test.parameter)
    is_assumed = bool(found) and factor is None
    spec = effect_named(test.effect).parameters[test.parameter]
    true = spec.default or 0.0
    if is_assumed:
        estimates = [e for causes in first.sets for c in causes if c.effect == test.effect for e in c.estimates]
        true = next((e.value for e in estimates if str(e) == test.name), true)
    elif factor is not None:
        at = None if test.joint is None else test.joint + 1
        true += sum(factor * one["amount"] for one in found if one["joint"] in (None, at))
    value = float(np.clip(true + test.sd * random.standard_normal(), spec.lower, spec.upper))
    return HandMeasurement(test.effect, test.parameter, test.joint, value, test.sd), is_assumed


def _rivals(result: Diagnosis) -> list[str]:
    """Labels of the likeliest set and of the likeliest of other effects, which an experiment is to separate."""
    labels = _labels(result)
    other = rival_of([{cause.effect for cause in causes} for causes in result.sets])
    return [labels[0], *([] if other is None else [labels[other]])]


def _labels(result: Diagnosis) -> list[str]:
    return [" + ".join(cause.label for cause in causes) for causes in result.sets]


def _holds(result: Diagnosis, hidden: list[dict[str, Any]]) -> bool:
    return any(is_exactly(hidden, one["effects"]) for one in as_mapping(result)["sets"])


def main(out: Path, cases: int) -> None:
    plans = {one.plan.seed: one.plan for one in load(RESULTS) if one.verdict and one.verdict["verdict"] == "ambiguous"}
    found = list[Separation]()
    for plan in plans.values():
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
    main(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 30)
