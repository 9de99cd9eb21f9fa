"""Diagnose the CSV files of a folder: what does the model get wrong about them, and why?

    python3 examples/diagnose_your_csv.py [FOLDER]

Reads every .csv file of FOLDER (default out/examples/diagnose_your_csv); a folder without any gets two, of a simulated
arm whose third spring is too stiff. Writes diagnosis.html, a page for the report, and extended.yaml to FOLDER.
Columns: t_s; q1_deg .. from the base; where known dq1_deg_s .. and u1_N, u2_N (docs/discovery.md, Data).
"""

import sys
from pathlib import Path

import numpy as np

from continuum.discovery import diagnose
from continuum.discovery.report import write_report
from continuum.discovery.words import verdict_in_words
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.recordings.recording_csv import read_recording_csv

MODEL = load_model("lamecc_prototype.yaml")  # or the path of your own model file


def make_two(folder: Path) -> None:
    """Write a release and a run in which the cables pull, in the documented columns."""
    arm = MODEL.with_values({"stiffness": MODEL.parameters.stiffness * [1.0, 1.0, 1.5, 1.0, 1.0]})  # [N m/rad]
    rng, t = np.random.default_rng(2), np.arange(0.0, 1.2, 1 / 120)  # [s]
    pull = 16.0 * np.sin(2 * np.pi * 1.1 * t)  # cable 1 pulls towards positive angles, cable 2 against it [N]
    runs = {"released": (np.full(5, np.radians(18.0)), 0 * pull), "pulled": (np.zeros(5), pull)}  # first angles [rad]
    header = ",".join(["t_s", *(f"q{joint}_deg" for joint in range(1, 6)), "u1_N", "u2_N"])
    for name, (start, force) in runs.items():
        u = np.column_stack([np.maximum(force, 0.0), np.maximum(-force, 0.0)])  # (n_times, 2) [N]
        theta = Simulator(arm).run(start, t, Tensions(t, u)).theta
        q = np.degrees(theta) + rng.normal(0.0, 0.05, theta.shape)  # with the sensors' noise [degrees]
        np.savetxt(folder / f"{name}.csv", np.column_stack([t, q, u]), "%.6f", ",", header=header, comments="")


def main(folder: Path) -> None:
    """Read, diagnose, print, and write the page."""
    folder.mkdir(parents=True, exist_ok=True)
    if not list(folder.glob("*.csv")):
        make_two(folder)
    files = sorted(folder.glob("*.csv"))
    recordings = [read_recording_csv(file) for file in files]
    result = diagnose(recordings, MODEL, with_power=False)  # True: also what these runs cannot show; takes longer
    print(f"{result.verdict.kind.value}: {verdict_in_words(result)}")
    for cause in result.causes:
        print(*(f"{one} = {one.value:.3g} ({one.low:.3g} to {one.high:.3g})" for one in cause.estimates))
    write_report(result, folder / "diagnosis.html", f"Made of {', '.join(file.name for file in files)}.")
    save_model(result.extended_model, folder / "extended.yaml")
    print(f"written: {folder}/diagnosis.html, {folder}/extended.yaml")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/diagnose_your_csv"))
