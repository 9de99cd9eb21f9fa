"""Compile the solver's entry points, or load them from their cache, before their first use.

After an installation, `python3 -m continuum.kinematics.compiled.warm_up` does this once for all programs.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.arm import Arm, Section
from continuum.kinematics.differential import DifferentialKinematics
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.ik_target import Target
from continuum.kinematics.inverse_kinematics import InverseKinematics


def warm_up() -> None:
    """Call every entry point once."""
    section = Section("section", n_joints=5, b=0.02, a=0.03)
    arm = Arm((section, replace(section, name="another")))
    InverseKinematics(arm).solve(Target([0.0, 0.0, section.length]))
    DifferentialKinematics(arm).rate([[0.0, 0.1], [0.0, 0.1]], [0.0, 0.0, 0.0])
    solve_fabrikc(arm, np.array([0.0, 0.0, section.length]))


if __name__ == "__main__":
    warm_up()
