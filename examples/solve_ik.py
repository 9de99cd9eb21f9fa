"""Inverse kinematics: a position, a position with a direction, and a target out of reach of an arm of three sections.

    python3 examples/solve_ik.py [FOLDER]

Prints the configuration of every section and the distance from the tip to the target, and writes the total length of
every cable to cable_lengths.csv in FOLDER (default out/examples/solve_ik).
"""

import sys
from pathlib import Path

import numpy as np

from continuum.arm import Arm, Section
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import jones_from_allen
from continuum.kinematics.ik_target import Target
from continuum.kinematics.inverse_kinematics import InverseKinematics
from continuum.kinematics.routing import tangle

TWISTS = np.radians([0.0, 30.0, 30.0])  # of each section about the tip of the one before [rad]
ARM = Arm(tuple(Section(f"section_{i}", n_joints=5, b=0.01925, a=0.032, twist=t) for i, t in enumerate(TWISTS, 1)))

TARGETS = {  # positions [m] in the frame of the base plate, z along the straight arm
    "position": Target([0.15, 0.0, 0.20]),
    "position and direction": Target([0.15, 0.0, 0.20], direction=[0.0, 0.0, 1.0]),
    "out of reach": Target([0.50, 0.0, 0.40]),
}


def main(out: Path) -> None:
    """Solve for every target, check the answer by the forward kinematics, and write the cables' lengths."""
    out.mkdir(parents=True, exist_ok=True)
    solver = InverseKinematics(ARM, objective="least_bending")
    lengths = []
    for name, target in TARGETS.items():
        answer = solver.solve(target)
        w = answer.configuration  # (u, v) of each section, (3, 2) [rad]
        phi, theta = np.degrees(jones_from_allen(w))
        residual = np.linalg.norm(arm_pose(w, ARM)[:3, 3] - target.position)  # |p(w) - p_target| [m]
        lengths.append(tangle(w, ARM))  # l(w), (12,) [m]
        print(f"{name}: {answer.status.name}, {1e3 * residual:.3g} mm from the target")
        print(f"  theta {np.round(theta, 1)} degrees towards phi {np.round(phi, 1)} degrees")
    file = out / "cable_lengths.csv"
    np.savetxt(file, lengths, "%.6f", ",", header=",".join(ARM.cable_names), comments="")
    print(f"written: {file}, a row for each target [m]")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/solve_ik"))
