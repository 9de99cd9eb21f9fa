"""From a ruler and a scale to the model file of your own arm, and to a first simulated release.

    python3 examples/own_arm.py [FOLDER]

An arm of four joints that hangs, with two cables. Writes my_arm.yaml, in which every parameter has a comment, and a
picture of the release to FOLDER (default out/examples/own_arm).
"""

import sys
from pathlib import Path

import numpy as np

from continuum.dynamics.commented_model import commented_model
from continuum.dynamics.model_file import load_model, model_from_mapping
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import slack
from continuum.recordings.motion_figure import write_motion_figure

# Ruler: half the distance from joint to joint, radius of the cables' holes, radius of a disc and its thickness [m].
B, A, R, H = 0.020, 0.028, 0.035, 0.008
MASS = 0.110  # scale: a link with its disc [kg]
LEVER, BENT = 0.060, np.radians(4.5)  # of a joint of the arm on its side: lever [m], angle [rad]
OUT, BACK = 1.10, 0.86  # spring balance at that angle on the way out and on the way back [N]


def measured(value: float, unit: str, how: str) -> dict[str, object]:
    """One value for all joints, as a model file has it."""
    return {"value": float(value), "unit": unit, "source": how}


def main(out: Path) -> None:
    """Turn measurements into parameters, write the file, load it, and release the arm."""
    out.mkdir(parents=True, exist_ok=True)
    parameters = {
        "mass": measured(MASS, "kg", "scale"),
        "center_of_mass": measured(B, "m", "ruler: in the disc, b beyond the joint"),
        "inertia": measured(MASS * (3 * R**2 + H**2) / 12, "kg m2", "a disc about its diameter"),
        "half_spacing": measured(B, "m", "ruler"),
        "hole_radius": measured(A, "m", "ruler"),
        "stiffness": measured((OUT + BACK) / 2 * LEVER / BENT, "N m/rad", "spring balance: mean of out and back"),
        "coulomb_friction": measured((OUT - BACK) / 2 * LEVER, "N m", "spring balance: half the difference"),
        "viscous_friction": measured(0.01, "N m s/rad", "guessed; continuum identify finds it from releases"),
    }
    described = model_from_mapping({"n_joints": 4, "inputs": "cables", "parameters": parameters})
    file = out / "my_arm.yaml"
    file.write_text(commented_model(described), encoding="utf-8")

    model, t = load_model(file), np.arange(0.0, 2.0, 1 / 120)  # [s]
    motion = Simulator(model).run(np.full(4, np.radians(15.0)), t)  # 60 degrees in total, let go at rest
    bend = np.degrees(motion.theta.sum(axis=1))
    p = model.parameters
    print(f"K = {p.stiffness[0]:.3f} N m/rad, tau_c = {p.coulomb_friction[0]:.4f} N m")
    print(f"released at {bend[0]:.0f} degrees, swings to {bend.min():.1f}, rests at {bend[-1]:.1f}")
    write_motion_figure(motion, slack(), p, out / "release.png")
    print(f"written: {file}; next: record your arm, then continuum diagnose --model {file} run_1.csv run_2.csv")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/own_arm"))
