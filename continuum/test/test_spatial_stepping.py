"""The step in time: energy, order, friction that sticks, and other engines."""

import itertools
from dataclasses import dataclass

import mujoco
import numpy as np
import pytest
from spatial_arms import equal_sections, in_mujoco

from continuum.dynamics.spatial.sensitivities import Tangent, simulate_tangent
from continuum.dynamics.spatial.terms import cable_terms, rigid_body_terms
from continuum.dynamics.spatial.time_stepping import COMPLETE, NOT_FINITE, initial_state, simulate


@dataclass
class Run:
    """One interval of constant inputs: state at its end, and with columns its derivatives (n, n_columns)."""

    status: int
    q: np.ndarray
    v: np.ndarray
    mode: np.ndarray
    q_by: np.ndarray | None = None
    v_by: np.ndarray | None = None


def run(arm, q, v, h, n_steps, command, *, holds=None, drive=None, free=None) -> Run:
    """Simulate ``n_steps`` of ``h`` [s]; with ``free`` also the derivatives, by these and by q and v of the start."""
    chain, joints, cables = arm
    n, n_cables = q.size, cables.first.size - 1
    state = initial_state(joints, q, v)
    holds = np.zeros(n_cables, bool) if holds is None else holds
    inputs = np.asarray(command, float)[None], (np.zeros(n) if drive is None else drive)[None]
    given = (inputs[0], inputs[0], inputs[1], inputs[1])
    q_out, v_out = np.zeros((2, 1, n))
    times = np.array([h * n_steps]), np.array([n_steps])
    if free is None:
        status, _ = simulate(chain, joints, cables, holds, state, *times, *given, q_out, v_out)
        return Run(status, q_out[0], v_out[0], state.mode)
    n_values = free.kind.size
    at_start = np.eye(2 * n)
    tangent = Tangent(
        np.hstack([np.zeros((n, n_values)), at_start[:n]]), np.hstack([np.zeros((n, n_values)), at_start[n:]]),
        np.zeros((n, n_values + 2 * n)),
    )  # fmt: skip
    q_by, v_by = np.zeros((2, 1, n, n_values + 2 * n))
    status, _ = simulate_tangent(
        chain, joints, cables, holds, free, state, tangent, *times, *given, q_out, v_out, q_by, v_by
    )
    return Run(status, q_out[0], v_out[0], state.mode, q_by[0], v_by[0])


def frictionless(arm):
    chain, joints, cables = arm
    still = np.zeros_like(joints.coulomb)
    return chain, joints._replace(viscous=still, coulomb=still), cables


def energy(arm, q, v, tension) -> float:
    """Kinetic energy, and potential of gravity, springs and tensions [J]."""
    chain, joints, cables = arm
    M = rigid_body_terms(chain, q, v, 0.0 * q)[1]
    lengths = cable_terms(chain, cables, q)[0]
    steps = np.linspace(0.0, 1.0, 9)  # of the work against gravity on the way to q, by Gauss's rule on eight pieces
    work = 0.0
    for low, high in itertools.pairwise(steps):
        for x, weight in zip(*np.polynomial.legendre.leggauss(8), strict=True):
            at = 0.5 * (low + high) + 0.5 * (high - low) * x
            work += 0.5 * (high - low) * weight * (rigid_body_terms(chain, at * q, 0.0 * q, 0.0 * q)[0] @ q)
    springs = 0.5 * joints.stiffness @ (q - joints.rest) ** 2
    return float(0.5 * v @ M @ v + work + springs + tension @ lengths)


def test_energy_of_a_swing_without_friction_is_kept():
    arm = frictionless(equal_sections(2, 3))
    n = arm[0].mass.size
    tension = np.linspace(1.0, 6.0, 6)
    q0 = np.linspace(-0.3, 0.3, n)
    straight, start = energy(arm, 0.0 * q0, 0.0 * q0, tension), energy(arm, q0, 0.0 * q0, tension)
    drifts = []
    for h in (1e-3, 5e-4):
        ends = [run(arm, q0, 0.0 * q0, h, round(t / h), tension) for t in (0.2, 0.35, 0.5)]
        drifts.append(max(abs(energy(arm, end.q, end.v, tension) - start) for end in ends) / abs(start - straight))
    assert drifts[0] < 1e-2
    assert drifts[1] < 0.35 * drifts[0]  # of second order


def test_equals_mujoco_where_both_know_the_physics():
    arm = frictionless(equal_sections(3, 3))
    arm = (arm[0], arm[1]._replace(viscous=0.0314 + 0.0 * arm[1].viscous), arm[2])
    n = arm[0].mass.size
    rng = np.random.default_rng(1)
    q0, tension = rng.normal(0.0, 0.1, n), rng.uniform(1.0, 10.0, 9)
    h, n_steps = 1e-4, 2000
    model = in_mujoco(*arm, step=h)
    data = mujoco.MjData(model)
    data.qpos[:], data.ctrl[:] = q0, tension
    mujoco.mj_step(model, data, n_steps)
    end = run(arm, q0, 0.0 * q0, h, n_steps, tension)
    assert np.rad2deg(abs(end.q - data.qpos).max()) < 0.02


def test_dry_friction_holds_what_it_can_hold():
    chain, joints, cables = equal_sections(1, 5, per_joint=1, n_cables=2)
    strong = joints._replace(coulomb=10.0 * joints.coulomb)
    q0 = np.full(5, 0.02)
    held = run((chain, strong, cables), q0, 0.0 * q0, 1e-3, 500, np.zeros(2))
    np.testing.assert_array_equal(held.q, q0)
    assert not held.mode.any()
    moving = run((chain, strong, cables), q0, np.full(5, 2.0), 1e-3, 2000, np.zeros(2))
    at_rest = run((chain, strong, cables), moving.q, moving.v, 1e-3, 500, np.zeros(2))
    assert not at_rest.v.any()
    np.testing.assert_array_equal(at_rest.q, moving.q)


def test_order_of_accuracy_while_the_modes_stay():
    chain, joints, cables = equal_sections(2, 2)
    smooth = (chain, joints._replace(coulomb=0.0 * joints.coulomb), cables)
    n = chain.mass.size
    q0, tension = np.linspace(0.2, -0.2, n), np.linspace(2.0, 8.0, 6)
    ends = [run(smooth, q0, 0.0 * q0, 0.1 / m, m, tension).q for m in (50, 100, 200, 6400)]
    errors = [abs(end - ends[-1]).max() for end in ends[:-1]]
    assert errors[1] < 0.35 * errors[0]
    assert errors[2] < 0.35 * errors[1]


@pytest.mark.parametrize("steepness", [2e3, 2e5])
def test_capstan_friction_slows_and_is_stable_at_any_steepness(steepness):
    chain, joints, cables = equal_sections(2, 3)
    n = chain.mass.size
    q0, tension = np.linspace(0.3, -0.3, n), np.linspace(2.0, 8.0, 6)
    smooth = joints._replace(coulomb=0.0 * joints.coulomb)
    rubbing = cables._replace(friction=0.2 + 0.0 * cables.friction, slope=steepness + 0.0 * cables.slope)
    fine = run((chain, smooth, rubbing), q0, 0.0 * q0, 1e-5, 30_000, tension)
    coarse = run((chain, smooth, rubbing), q0, 0.0 * q0, 1e-3, 300, tension)
    assert coarse.status == fine.status == COMPLETE
    assert np.rad2deg(abs(coarse.q - fine.q).max()) < 0.5


def test_a_held_length_is_kept():
    chain, joints, cables = equal_sections(2, 3)
    n = chain.mass.size
    stiff = cables._replace(stiffness=1e5 + 0.0 * cables.stiffness, damping=50.0 + 0.0 * cables.damping)
    straight = cable_terms(chain, stiff, np.zeros(n))[0]
    holds = np.array([True, False, False, True, False, False])
    command = np.where(holds, straight - 2e-3, 1.0)
    end = run((chain, joints, stiff), np.zeros(n), np.zeros(n), 1e-3, 3000, command, holds=holds)
    lengths = cable_terms(chain, stiff, end.q)[0]
    assert end.status == COMPLETE
    np.testing.assert_allclose(lengths[holds], command[holds], atol=5e-4)  # the rest is the stretch of the cable


def test_what_is_not_finite_is_said():
    arm = equal_sections(1, 2)
    q0 = np.zeros(4)
    assert run(arm, q0, np.full(4, np.nan), 1e-3, 5, np.zeros(3)).status == NOT_FINITE
    massless = (arm[0]._replace(mass=0.0 * arm[0].mass), arm[1]._replace(viscous=0.0 * q0, stiffness=0.0 * q0), arm[2])
    assert run(massless, q0, np.ones(4), 1e-3, 5, np.zeros(3)).status == NOT_FINITE
