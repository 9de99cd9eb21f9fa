"""Release the thesis's prototype from a bend of 90 degrees, with and without the friction of its joints.

    python3 examples/simulate_release.py [FOLDER]

Prints the cable tension that holds the bend, and how the arm swings. Writes the motions as tables and as pictures to
FOLDER (default out/examples/simulate_release).
"""

import sys
from pathlib import Path

import numpy as np

from continuum.dynamics.model_file import load_model
from continuum.dynamics.pulled_posture import pulled_posture
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import slack
from continuum.recordings.motion_figure import write_motion_figure
from continuum.recordings.motion_table import write_motion_table

MODEL = load_model("lamecc_prototype.yaml")  # or the path of your own model file
NO_FRICTION = {"viscous_friction": 0.0, "coulomb_friction": 0.0}  # tau_mu [N m s/rad], tau_c [N m] of Eq. 13
BEND = np.radians(90.0)  # sum of the joint angles [rad]
TIMES = np.arange(0.0, 2.0, 1 / 120)  # [s]


def main(out: Path) -> None:
    """Hold the arm by one cable, cut it, and integrate M(q) q'' + C q' + tau_f(q') + K q + G(q) = 0 (Eq. 12)."""
    out.mkdir(parents=True, exist_ok=True)
    held = pulled_posture(MODEL, BEND)
    print(f"held by {held.tension.max():.2f} N at joint angles of {np.round(np.degrees(held.theta), 1)} degrees")

    for name, model in {"with_friction": MODEL, "without_friction": MODEL.with_values(NO_FRICTION)}.items():
        motion = Simulator(model).run(held.theta, TIMES)  # from rest, cables slack
        bend = np.degrees(motion.theta.sum(axis=1))  # (n_times,) [degrees]
        speed = np.degrees(abs(motion.theta_rate)).max()
        print(f"{name}: {motion.status.value}; fastest joint {speed:.0f} degrees/s")
        print(f"  swings to {bend.min():.1f} degrees, is at {bend[-1]:.1f} degrees after {TIMES[-1]:.1f} s")
        write_motion_table(motion, slack(), out / f"{name}.csv")
        write_motion_figure(motion, slack(), model.parameters, out / f"{name}.png")
    print(f"written to {out}: {', '.join(sorted(path.name for path in out.iterdir()))}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/simulate_release"))
