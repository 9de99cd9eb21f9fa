"""Compile the integrator's loops, or load them from their cache, before their first use.

After an installation, `python3 -m continuum.dynamics.warm_up` does this once for all programs.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.spatial.arm_model import load_arm_model
from continuum.dynamics.spatial.simulation import path_lengths, simulate_arm, tip_poses


def warm_up() -> None:
    """Simulate the prototype and an arm in space for an instant."""
    model, times = load_model("lamecc_prototype.yaml"), np.array([0.0, 1e-3])
    Simulator(model).run(np.zeros(model.n_joints), times)
    arm = load_arm_model("three_sections.yaml")
    motion = simulate_arm(arm, np.zeros(arm.n), times)
    tip_poses(arm, motion.q)
    path_lengths(arm, motion.q)


if __name__ == "__main__":
    warm_up()
