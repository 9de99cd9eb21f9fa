"""Dry friction sees a slip rate of its own while motion is estimated, and the joints' own rate in a simulation."""

from dataclasses import replace

import casadi
import numpy as np
import pytest
from continuum_laws.differences import assert_same_derivatives, differences
from continuum_laws.strategies import LAW
from estimation_arm import N, drawn_motion, drawn_params, drawn_values, left_side, structure
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.balance import balance
from continuum.dynamics.compiled.symbolic_balance import SymbolicBalance
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.values import parameter_vector, with_vector
from continuum.estimation.motion_equations import MotionEquations, evaluate, packed, torques

pytestmark = pytest.mark.slow

SEEDS = st.integers(0, 10**6)
STATEFUL = list(structure().stateful)


def with_states(name: str, random: np.random.Generator) -> Model:
    """A random arm with one effect that has states, and all that have none."""
    effect = structure().stateful[name].effect
    base = with_vector(structure().model, drawn_values(random))
    return replace(base, effects=(*base.effects, ActiveEffect(effect, drawn_params(effect, random))))


def bent_one_way(random: np.random.Generator, x: np.ndarray) -> np.ndarray:
    """A state where no cable's wrap is about to change its side."""
    return np.concatenate([random.choice([-1, 1]) * random.uniform(0.05, 0.5, N), x[N:]])


def linear_parts(values: np.ndarray, x: np.ndarray, v: np.ndarray, u: np.ndarray, slip: np.ndarray) -> list[np.ndarray]:
    """r, dr/dv, dr/dx of the compiled model."""
    motion = np.concatenate([x, v]).reshape(1, 3, N)
    out = evaluate(structure().equations.linear, packed(motion, u[None], slip[None], values), N + 3 * N * N)[0]
    r, by_v, by_x = np.split(out, [N, N + N * N])
    return [r, by_v.reshape(N, N).T, by_x.reshape(2 * N, N).T]


@LAW
@given(SEEDS)
def test_estimated_equations_have_the_derivatives_at_a_given_slip_rate(seed: int) -> None:
    random = np.random.default_rng(seed)
    values, along = drawn_values(random), drawn_motion(random, 1)
    x, v, u, slip = bent_one_way(random, along.motion[0, :2].ravel()), along.motion[0, 2], along.u[0], along.slip[0]
    model = with_vector(structure().model, values)
    r, by_v, by_x = linear_parts(values, x, v, u, slip)
    np.testing.assert_allclose(r, left_side(model, x, v, u, slip), rtol=1e-9, atol=1e-12)
    assert_same_derivatives(by_v, differences(lambda v: left_side(model, x, v, u, slip), v, 1.0))
    assert_same_derivatives(by_x, differences(lambda x: left_side(model, x, v, u, slip), x, 2e-3))


@LAW
@given(SEEDS)
def test_friction_s_derivative_by_the_rate_is_the_viscous_one(seed: int) -> None:
    """Whatever dry friction there is, and whatever rate it sees; more viscous friction is more slope at its joint."""
    random = np.random.default_rng(seed)
    values, along, slots = drawn_values(random, with_effects=False), drawn_motion(random, 2), structure().slots
    x, v, u = along.motion[0, :2].ravel(), along.motion[0, 2], along.u[0]
    of_rate = linear_parts(values, x, v, u, along.slip[0])[2][:, N:]
    rougher = values.copy()
    for name in ("coulomb_friction", "stribeck_gain", "friction_slope"):
        rougher[slots[name]] *= random.uniform(2, 5)
    rubbed, _, by_x = linear_parts(rougher, x, v, u, along.slip[1])
    np.testing.assert_allclose(by_x[:, N:], of_rate, rtol=1e-9, atol=1e-12)
    assert not np.allclose(rubbed, linear_parts(values, x, v, u, along.slip[1])[0], atol=1e-4)
    more, thicker = random.uniform(0.01, 0.1, N), values.copy()
    thicker[slots["viscous_friction"]] += more
    by_x = linear_parts(thicker, x, v, u, along.slip[0])[2]
    np.testing.assert_allclose(by_x[:, N:] - of_rate, np.diag(more), rtol=1e-7, atol=1e-10)


@pytest.mark.parametrize("name", STATEFUL)
def test_what_an_effect_adds_to_the_joints_rates_dry_friction_sees_too(name: str) -> None:
    """With its states, as a base plate that turns under the first joint."""
    random = np.random.default_rng(len(name))
    model, along = with_states(name, random), drawn_motion(random, 20)
    z, rate = random.uniform(0.05, 0.5, (2, 20, model.n_states))
    rows = packed(along.motion, along.u, along.slip, parameter_vector(model), z, rate)
    found = torques(MotionEquations(model), rows, N)
    for k, (m, u, slip) in enumerate(zip(along.motion, along.u, along.slip, strict=True)):
        left = left_side(model, np.concatenate([m[0], m[1], z[k]]), np.concatenate([m[2], rate[k]]), u, slip)
        np.testing.assert_allclose(found[k], -left[:N], rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("name", [None, *STATEFUL])
def test_a_simulation_s_equations_keep_all_of_friction_s_derivative(name: str | None) -> None:
    """They are those of the joints' own rate, and so are their derivatives."""
    random = np.random.default_rng(1)
    model = with_vector(structure().model, drawn_values(random)) if name is None else with_states(name, random)
    along, extra = drawn_motion(random, 1), model.n_states
    x = np.concatenate([bent_one_way(random, along.motion[0, :2].ravel()), random.uniform(0.05, 0.3, extra)])
    x[N : 2 * N] *= 0.1  # slow: there dry friction changes most
    v, u = np.concatenate([along.motion[0, 2], random.normal(0, 1, extra)]), along.u[0]
    given_all = np.concatenate([x, v, u, parameter_vector(model), [0.0]])
    out = np.array(SymbolicBalance(model).newton(casadi.DM(given_all))).ravel()
    size = N + extra
    np.testing.assert_allclose(out[:size], balance(model, x, v, u), rtol=1e-9, atol=1e-10)
    np.testing.assert_allclose(out[:size], left_side(model, x, v, u, x[N : 2 * N]), rtol=1e-9, atol=1e-10)
    by_x = out[size * (1 + size) :].reshape(-1, size).T
    by_rate = differences(
        lambda w: balance(model, np.concatenate([x[:N], w, x[2 * N :]]), v, u)[:N], x[N : 2 * N], 1e-4
    )
    assert_same_derivatives(by_x[:N, N : 2 * N], by_rate, 1e-6)
