"""Compile the integrator's loops, or load them from their cache, before their first use.

After an installation, `python3 -m continuum.dynamics.warm_up` does this once for all programs.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator


def warm_up() -> None:
    """Simulate the prototype for an instant."""
    model = load_model("lamecc_prototype.yaml")
    Simulator(model).run(np.zeros(model.n_joints), np.array([0.0, 1e-3]))


if __name__ == "__main__":
    warm_up()
