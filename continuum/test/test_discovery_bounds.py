"""What a fit tries stays what makes physical sense."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.baseline import problem_of
from continuum.discovery.problem import Problem, State, point_of
from continuum.dynamics.model import with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import with_vector
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording


@lru_cache
def problem() -> Problem:
    model, times = with_dry_friction(load_model("lamecc_prototype.yaml")), np.arange(0, 0.5, 0.01)
    moved = Simulator(model).run(np.full(5, 0.1), times)
    return problem_of(Structure(model, with_tension=False), [Recording("release", times, moved.theta)])


@given(st.floats(-3, 3), st.floats(-3, 3), st.integers(0, 4))
def test_friction_never_drives_an_arm(effect: float, ordinary: float, joint: int) -> None:
    """An effect's size and an ordinary difference of one joint add up, to no friction at the least."""
    shared = {("joint_friction", "coulomb", j): effect for j in range(5)}
    shared[("joint_friction", "viscous", joint)] = ordinary
    values = point_of(problem(), State(shared, ({},), {}, {}, 1.6, (), ())).values
    p = with_vector(problem().structure.model, values).changed_parameters
    assert np.all(p.coulomb_friction >= 0)
    assert np.all(p.viscous_friction >= 0)
