"""Hypotheses that no recording can tell apart are one; those that some can, are not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from continuum.discovery.baseline import fitted_baseline, problem_of
from continuum.discovery.problem import linearise
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording

TIMES = np.arange(0, 0.5, 1 / 120)


def same(center_of_tip: float) -> dict[str, list[str]]:
    """By an arm whose last link's centre of mass is at a part of the way to the tip."""
    model = load_model("lamecc_prototype.yaml")
    p = model.parameters
    center = np.array(p.center_of_mass, dtype=float)
    center[-1] = center_of_tip * float(p.tip[-1])
    model = replace(model.with_values({"center_of_mass": list(center)}))
    moved = Simulator(model).run(np.full(5, 0.2), TIMES)
    structure = Structure(model, ["inertia", "tip_payload", "rest_angle", "joint_stiffness"], with_tension=False)
    problem = problem_of(structure, [Recording("swing", TIMES, moved.theta, moved.theta_rate)])
    return linearise(problem, fitted_baseline(problem)).library.same


@pytest.mark.parametrize(("center", "expected"), [(1.0, {"tip_payload": ["inertia@5"]}), (0.8, {})])
def test_a_weight_at_the_tip_is_mass_of_a_last_link_whose_centre_is_there(center: float, expected: object) -> None:
    assert same(center) == expected
