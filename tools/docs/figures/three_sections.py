"""The picture of an arm of three sections that is released in space."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from continuum.dynamics.spatial.arm_model import load_arm_model
from continuum.dynamics.spatial.simulation import simulate_arm
from continuum.kinematics.configuration import allen_from_jones
from continuum.recordings.spatial_motion_figure import write_spatial_figure
from tools.docs.small_png import shrink


def draw_three_sections(path: Path) -> None:
    """Release the arm as docs/model-my-arm.md does, and write the picture."""
    model = load_arm_model("three_sections.yaml")
    azimuth, bend = np.radians([0.0, 90.0, 180.0]), np.radians([30.0, 40.0, 30.0])
    motion = simulate_arm(model, model.bent(allen_from_jones(azimuth, bend)), np.arange(241) / 120.0)
    write_spatial_figure(model, motion, None, path)
    shrink(path)
