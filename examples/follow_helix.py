"""Follow the thesis's helix: configurations by inverse kinematics, cable rates by the Jacobians.

    python3 examples/follow_helix.py [FOLDER]

Prints the tip's error, and how far the cable rates are from the differences of the cable lengths. Writes helix.csv and
helix.png to FOLDER (default out/examples/follow_helix).
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from continuum.arm import Arm, Section
from continuum.kinematics.differential import DifferentialKinematics
from continuum.kinematics.ik_target import Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics
from continuum.kinematics.routing import tangle, tangle_rates
from trajectory_generator.from_parameters import trajectory_from_mapping

TWISTS = np.radians([0.0, 30.0, 30.0])  # of each section about the tip of the one before [rad]
ARM = Arm(tuple(Section(f"section_{i}", n_joints=5, b=0.01925, a=0.032, twist=t) for i, t in enumerate(TWISTS, 1)))
HELIX = {"path": "helix", "helix.radius": 0.15, "helix.pitch": 0.08, "helix.z_start": 0.01, "helix.z_end": 0.30}  # [m]
RATE = 50.0  # poses a second [Hz]


def main(out: Path) -> None:
    """Sample the helix, solve for each pose from the one before, and derive the cables' lengths and rates."""
    out.mkdir(parents=True, exist_ok=True)
    trajectory = trajectory_from_mapping(HELIX)
    t = trajectory.times(RATE)  # (n,) [s]
    wanted = trajectory.sample(t)

    path = InverseKinematics(ARM, tolerance=1e-9).follow(Targets(wanted.position))
    w = path.configurations  # (n, 3, 2) [rad]
    differential = DifferentialKinematics(ARM)
    w_rate = np.array([differential.rate(*now).rate for now in zip(w, wanted.linear_velocity, strict=True)])
    lengths = tangle(w, ARM)  # l(w), (n, 12) [m]
    rates = tangle_rates(w, w_rate, ARM)  # dl/dt = J_lw(w) dw/dt, (n, 12) [m/s]

    print(f"{path.solved.sum()} of {t.size} poses reached, tip error at most {1e9 * path.distances.max():.2g} nm")
    differences = np.gradient(lengths, t, axis=0)
    print(f"cable rates up to {1e3 * abs(rates).max():.1f} mm/s; median distance to the slope of the length")
    print(f"  {1e3 * np.median(abs(rates - differences)):.2g} mm/s")

    table = np.column_stack([t, lengths])
    np.savetxt(out / "helix.csv", table, "%.6f", ",", header=",".join(["t_s", *ARM.cable_names]), comments="")
    figure = Figure(figsize=(9, 4), layout="constrained")
    left, right = figure.subplots(1, 2)
    left.plot(t, 1e3 * lengths)
    left.set(xlabel="time [s]", title="Cable lengths [mm]")
    right.plot(t, 1e3 * rates)
    right.set(xlabel="time [s]", title="Cable rates [mm/s]")
    figure.savefig(out / "helix.png", dpi=80)
    print(f"written: {out}/helix.csv, {out}/helix.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/follow_helix"))
