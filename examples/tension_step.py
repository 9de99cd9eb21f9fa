"""A step of one cable's tension: the path of the tip with and without the friction of cables and joints.

    python3 examples/tension_step.py [FOLDER]

Cable 1 pulls with 15 N for one second, then with nothing. Prints where the tip stands under tension and after it;
writes the path to tip.csv and tip.png in FOLDER (default out/examples/tension_step).
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from continuum.dynamics.model_file import load_model
from continuum.dynamics.planar.backbone import backbone
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions

RUBBING = load_model("lamecc_prototype.yaml")
MODELS = {
    "all friction": RUBBING,
    "no capstan": RUBBING.with_values({"capstan_friction": 0.0}),  # mu_c of Eq. 15: T' = T exp(-mu_c wrap)
    "no dry friction": RUBBING.with_values({"capstan_friction": 0.0, "coulomb_friction": 0.0}),  # tau_c of Eq. 13 [N m]
}
STEP = Tensions(np.array([0.0, 0.2, 1.2]), np.array([[0.0, 0.0], [15.0, 0.0], [0.0, 0.0]]), held=True)  # [s], [N]
TIMES = np.arange(0.0, 2.2, 1 / 200)  # [s]


def main(out: Path) -> None:
    """Integrate each model from the straight posture at rest, and follow its tip in the plane."""
    out.mkdir(parents=True, exist_ok=True)
    figure = Figure(figsize=(9, 4), layout="constrained")
    plane, course = figure.subplots(1, 2)
    columns = [TIMES]
    for name, model in MODELS.items():
        motion = Simulator(model).run(np.zeros(model.n_joints), TIMES, STEP)
        tip = np.array([backbone(theta, model.parameters)[-1] for theta in motion.theta])  # (n_times, 2) [m]
        pulled, after = tip[np.searchsorted(TIMES, 1.2) - 1], tip[-1]
        print(f"{name}: tip {1e3 * pulled[0]:.2f} mm aside at the end of the pull, {1e3 * after[0]:.2f} mm 1 s later")
        plane.plot(*(1e3 * tip.T))
        course.plot(TIMES, 1e3 * tip[:, 0], label=name)
        columns += [*tip.T]
    plane.set(xlabel="aside [mm]", ylabel="up [mm]", aspect="equal", title="Path of the tip")
    course.set(xlabel="time [s]", ylabel="aside [mm]")
    course.legend()
    figure.savefig(out / "tip.png", dpi=80)
    header = ",".join(["t_s", *(f"{name.replace(' ', '_')}_{axis}_m" for name in MODELS for axis in ("aside", "up"))])
    np.savetxt(out / "tip.csv", np.column_stack(columns), "%.6f", ",", header=header, comments="")
    print(f"written: {out}/tip.csv, {out}/tip.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/tension_step"))
