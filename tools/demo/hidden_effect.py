"""The complete main task: an effect is hidden in a simulated arm and found from its recordings alone.

    python3 -m tools.demo.hidden_effect --seed 3

The arm is that of the blind tests (MuJoCo, true dry friction, sensor noise); it shares no code with the library. The
seed determines the effect, its place and size, the arm's parameters, its motions and the noise. The diagnosis receives
only the recordings and the nominal model.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np
from blind.mujoco_plant import make_case, write_case
from blind.mujoco_plant.case import Case
from blind.mujoco_plant.effects import EFFECTS, LIBRARY

from continuum.discovery import diagnose
from continuum.discovery.decision import Kind
from continuum.discovery.report import write_report
from continuum.discovery.result import Diagnosis
from continuum.discovery.words import verdict_in_words
from continuum.dynamics.model_file import load_model, save_model
from continuum.recordings.recording_csv import read_recording_csv
from continuum.whole_file import write_figure
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
    """Return verdict, truth and improvement, one line each."""
    (hidden,) = case.truth.effects
    place = f" at joint {hidden.joint}" if hidden.joint is not None else ""
    named = [cause.label for cause in result.causes] if result.verdict.kind is Kind.CAUSE else []
    before, after = (
        np.degrees(np.sqrt(np.mean([loop.error(r, run.theta) ** 2 for r, run in enumerate(result.recordings)])))
        for loop in (result.before, result.after)
    )
    unit = "" if EFFECTS[hidden.name].unit == "1" else f" {EFFECTS[hidden.name].unit}"
    lines = [
        f"Verdict: {result.verdict.kind.value}{': ' if named else ''}{', '.join(named)}. {verdict_in_words(result)}",
        f"Hidden was: {hidden.name}{place}, {hidden.amount:.3g}{unit}.",
    ]
    if result.is_extended:
        lines.append(f"Added to the model, it lowers the open-loop error from {before:.2f} to {after:.2f} degrees.")
    return lines


if __name__ == "__main__":
    sys.exit(in_one_line(main))
