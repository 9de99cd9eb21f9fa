"""The complete main task: an effect is hidden in a simulated arm and found from its recordings alone.

    python3 -m tools.demo.hidden_effect --seed 3

The arm is that of the blind tests (MuJoCo, true dry friction, sensor noise); it shares no code with the library. The
seed determines the effect, its place and size, the arm's parameters, its motions and the noise. The diagnosis receives
only the recordings and the nominal model.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from pathlib import Path

import numpy as np
from blind.mujoco_plant import make_case, write_case
from blind.mujoco_plant.case import Case, Truth
from blind.mujoco_plant.effects import LIBRARY
from blind.mujoco_plant.effects.cables import ElasticCable
from blind.mujoco_plant.effects.springs import HardeningSpring

from continuum.discovery import diagnose
from continuum.discovery.decision import Kind
from continuum.discovery.report import write_report
from continuum.discovery.result import Diagnosis
from continuum.discovery.words import estimate_in_words, estimate_name, verdict_in_words
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model_file import load_model, save_model
from continuum.identification.estimate import Estimate
from continuum.recordings.recording_csv import read_recording_csv
from continuum.whole_file import write_figure
from tools.benchmarks.discovery.figures import SAME
from tools.one_line import in_one_line

MODEL = "lamecc_prototype.yaml"
EFFECT = "hidden_effect"  # folder of recordings, and stem of files


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, required=True, help="seed of all random numbers")
    parser.add_argument("--out", type=Path, default=Path("out/demo"), help="folder; default %(default)s")
    options = parser.parse_args()
    find_hidden_effect(options.seed, options.out)


def find_hidden_effect(seed: int, out: Path) -> None:
    """Hide an effect, diagnose, print, and write recordings, page, picture and extended model to ``out``."""
    began = time.perf_counter()
    case = hidden_case(seed)
    files = write_case(case, out / EFFECT)
    print(f"An effect is hidden in a simulated arm (seed {seed}); the diagnosis gets its {len(files)} recordings.")
    recordings = [read_recording_csv(file) for file in files]
    result = diagnose(recordings, load_model(MODEL), with_power=False)
    page, picture, model = (out / f"{EFFECT}{suffix}" for suffix in (".html", ".png", ".yaml"))
    write_report(result, page, f"Made by make demo, seed {seed}.")
    write_figure(picture, result.plot(), dpi=110)
    save_model(result.extended_model, model)
    for line in answer(case, result):
        print(line)
    print(f"written: {page}, {picture}, {model}; {time.perf_counter() - began:.0f} s")


def hidden_case(seed: int) -> Case:
    """Return two releases and two pulls of an arm with one large effect of the library."""
    name = str(np.random.default_rng(seed).choice(LIBRARY))
    return make_case((name,), size="large", dataset="mixed", seed=seed)


def answer(case: Case, result: Diagnosis) -> list[str]:
    """Return verdict, truth, finding and improvement, one line each."""
    named = [cause.label for cause in result.causes] if result.verdict.kind is Kind.CAUSE else []
    before, after = (
        np.degrees(np.sqrt(np.mean([loop.error(r, run.theta) ** 2 for r, run in enumerate(result.recordings)])))
        for loop in (result.before, result.after)
    )
    lines = [
        f"Verdict: {result.verdict.kind.value}{': ' if named else ''}{', '.join(named)}. {verdict_in_words(result)}"
    ]
    lines.append(f"Hidden was: {hidden_in_words(case.truth)}.")
    if result.is_extended:
        found = [one for cause in result.causes for one in cause.estimates]
        lines.append(f"Found, with 95 % intervals: {'; '.join(map(in_words, found))}.")
    if result.is_extended:
        lines.append(f"Added to the model, it lowers the open-loop error from {before:.2f} to {after:.2f} degrees.")
    return lines


def hidden_in_words(truth: Truth) -> str:
    """Return the hidden values by the names and in the units in which a diagnosis states those that it finds."""
    (hidden,) = truth.effects
    joint = None if hidden.joint is None else hidden.joint - 1
    values = {name: factor * hidden.amount for name, factor in SAME.get(hidden.name, {}).items()}
    if isinstance(hidden, ElasticCable):
        values = {"lag": hidden.amount * hidden.winch_friction, "stiffness": 1 / hidden.amount}
    if isinstance(hidden, HardeningSpring):
        values = {"cubic": float(np.mean(truth.parameters.stiffness)) * hidden.amount}
    if not values:
        place = f" at joint {hidden.joint}" if hidden.joint is not None else ""
        return f"{hidden.name}{place}, {hidden.amount:.3g} {hidden.unit}, a measure that the library does not have"
    specs = effect_named(hidden.name).parameters
    none = math.nan  # the truth has no interval
    return "; ".join(
        in_words(Estimate(f"{hidden.name}.{name}", joint, "", value, none, none, specs[name].unit, specs[name].meaning))
        for name, value in values.items()
    )


def in_words(one: Estimate) -> str:
    """Return name, value, interval if it has one, and unit."""
    return f"{estimate_name(one)} {estimate_in_words(one)}"


if __name__ == "__main__":
    sys.exit(in_one_line(main))
