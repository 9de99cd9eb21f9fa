"""Unknowns of sets: each is one number, and none is the baseline's under another name."""

from __future__ import annotations

import numpy as np

from continuum.discovery.baseline import problem_of
from continuum.discovery.gauss_newton import modes_along
from continuum.discovery.problem import Linearised, State, linearise
from continuum.discovery.search import Found
from continuum.discovery.sensitivities import is_linear
from continuum.discovery.unknowns import Unknowns
from continuum.dynamics.model import with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.estimation.friction_modes import friction_modes
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording

EVERYWHERE = tuple(range(5))


def about_a_release() -> Linearised:
    """All hypotheses without tension."""
    model, times = with_dry_friction(load_model("lamecc_prototype.yaml")), np.arange(0, 0.5, 1 / 120)
    theta = Simulator(model).run(np.radians([14.0, 10, 12, 9, 8]), times).theta
    problem = problem_of(Structure(model, with_tension=False), [Recording("run", times, theta)])
    ways = tuple(run.first_guess() for run in problem.runs)
    modes = tuple(friction_modes(run, way, np.zeros(5)) for run, way in zip(problem.runs, ways, strict=True))
    state = State({}, ({},), {}, {}, 1.6, ways, modes)
    return linearise(problem, State({}, ({},), {}, {}, 1.6, ways, modes_along(problem, state)))


def test_a_set_begins_where_each_of_its_unknowns_is_said_to() -> None:
    """Also where an effect and an ordinary difference of parts change the same value."""
    lin, random = about_a_release(), np.random.default_rng(0)
    for h in filter(is_linear, lin.library.hypotheses):
        found = Found(lin, (h,))
        every = Unknowns(lin.problem, found, {}).all
        start = {one.key: float(np.clip(0.01 * random.random(), one.lower, one.upper)) for one in every}
        begun = [one.start for one in Unknowns(lin.problem, found, start).all]
        np.testing.assert_array_equal(begun, list(start.values()), h.label)


def test_springs_and_friction_of_all_joints_are_the_baseline_s() -> None:
    lin = about_a_release()
    covered = lin.problem.coordinates.covered
    assert {"stiffness", "viscous_friction", "joint_stiffness.excess", "joint_friction.viscous"} <= covered
    assert not {"mass", "link_length", "inertia.mass", "rest_angle.angle"} & covered
    at_all = {h.effect for h in lin.library.hypotheses if h.joints == EVERYWHERE}
    assert "rest_angle" in at_all
    assert not {"joint_stiffness", "joint_friction"} & at_all
