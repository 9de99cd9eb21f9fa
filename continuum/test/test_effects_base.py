"""A compliant base and a payload: Lagrange's equations and energy."""

from dataclasses import replace

import casadi
import numpy as np
from continuum_laws.differences import differences
from dynamics_laws import FRICTIONLESS, active, energies, prototype_model, random_parameters
from effects_laws import LOOSE, RELEASED, N, effect_of, extended, resting_state, simulator

from continuum.dynamics.balance import balance
from continuum.dynamics.model import Model
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.rigid_body import gravity_potential
from continuum.dynamics.values import parameter_vector


def lagrange(p: Parameters, q: np.ndarray, rate: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
    """d/dt dL/dq' - dL/dq of plate and links without springs, coordinates (psi, theta), from positions alone."""
    n = p.n_joints
    angles, rates = casadi.SX.sym("q", n + 1), casadi.SX.sym("w", n + 1)
    phi, turn = casadi.cumsum(angles), casadi.cumsum(rates)
    lever = np.concatenate([p.half_spacing[:1], p.joint_spacing])
    x = z = energy = 0
    for i in range(n + 1):
        if i > 0:
            mass, c = p.mass[i - 1], p.center_of_mass[i - 1]
            position = casadi.vertcat(x + c * casadi.sin(phi[i]), z + c * casadi.cos(phi[i]))
            velocity = casadi.jtimes(position, angles, rates)
            height = casadi.dot(position, casadi.vertcat(-np.sin(p.hang_angle[0]), np.cos(p.hang_angle[0])))
            energy += mass * casadi.dot(velocity, velocity) / 2 + p.inertia[i - 1] * turn[i] ** 2 / 2
            energy += mass * p.gravity[0] * height
        x, z = x + lever[i] * casadi.sin(phi[i]), z + lever[i] * casadi.cos(phi[i])
    momentum = casadi.gradient(energy, rates)
    second = casadi.SX.sym("a", n + 1)
    force = casadi.jtimes(momentum, rates, second) + casadi.jtimes(momentum, angles, rates)
    law = casadi.Function("law", [angles, rates, second], [force - casadi.gradient(energy, angles)])
    return np.array(law(q, rate, acceleration)).ravel()


def test_a_plate_on_a_spring_obeys_lagrange() -> None:
    random = np.random.default_rng(1)
    for _ in range(10):
        p = random_parameters(random, N)
        q, rate, acceleration = random.normal(size=(3, N + 1)) * [[0.5], [3.0], [30.0]]
        expected = lagrange(p, q, rate, acceleration)
        model = extended(Model(p), "base_compliance", {"compliance": 0.3, "frequency": 50.0, "damping": 0.2})
        relative = np.concatenate([q[1:], rate[1:]])
        seen, seen_rate, seen_acceleration = (np.append(c[0] + c[1], c[2:]) for c in (q, rate, acceleration))
        x = np.concatenate([seen, seen_rate, [q[0], rate[0]]])
        v = np.concatenate([seen_acceleration, [rate[0], acceleration[0]]])
        found = balance(model, x, v, np.array([3.0, 1.0]))
        joints = balance(
            Model(replace(p, mass=1e-9 + 0 * p.mass, inertia=0 * p.inertia)), relative, acceleration[1:], [3.0, 1.0]
        )
        np.testing.assert_allclose(found[:N], expected[1:] + joints, rtol=1e-6, atol=1e-7)
        plate = acceleration[0] / 50.0**2 + 2 * 0.2 * rate[0] / 50.0 + q[0]
        np.testing.assert_allclose(found[N:], [0.0, plate + 0.3 * expected[0]], rtol=1e-10, atol=1e-10)


def test_a_plate_without_damping_keeps_the_energy_of_arm_and_mount() -> None:
    e, w = 0.2, 60.0
    model = extended(prototype_model(N).with_values(FRICTIONLESS), "base_compliance", {"compliance": e, "frequency": w})
    values = parameter_vector(model)
    values[-1] = 0.0  # damping, below its bound
    x0 = resting_state(model, RELEASED, LOOSE)
    states = simulator("base_compliance").around(model).run(x0, np.linspace(0, 0.4, 9), None, values).states
    total = []
    for state in states:
        q = np.concatenate([state[-2:-1], [state[0] - state[-2]], state[1:N]])
        rate = np.concatenate([state[-1:], [state[N] - state[-1]], state[N + 1 : 2 * N]])
        momentum = lagrange(model.parameters, q, 0 * rate, rate) - lagrange(model.parameters, q, 0 * rate, 0 * rate)
        spring = (np.sum(model.parameters.stiffness * q[1:] ** 2) + q[0] ** 2 / e + rate[0] ** 2 / (e * w**2)) / 2
        p, phi = model.parameters, np.cumsum(q)
        height = gravity_potential(phi[1:], p) - p.gravity * np.sum(p.mass) * p.half_spacing[0] * np.cos(phi[0])
        total.append(rate @ momentum / 2 + spring + height[0])
    assert np.ptp(states[:, -2]) > 0.05
    assert np.ptp(total) < 1e-5


def test_a_payload_is_a_point_mass_on_the_tip_disc() -> None:
    """The last link with it falls and turns as one with a link more on top, of no length, that is held straight."""
    p = random_parameters(np.random.default_rng(2), N)
    one = active(effect_of("tip_payload"), mass=0.3)
    loaded = one.effect.change_parameters(p, one.values)
    theta, rate = np.array([0.3, -0.2, 0.5, 0.1, 0.4]), np.array([1.0, -2.0, 0.5, 3.0, 1.0])

    def tip(q: np.ndarray) -> np.ndarray:
        phi, reach = np.cumsum(q), np.append(p.joint_spacing[:-1], p.half_spacing[-1])
        return np.array([np.sum(reach * np.sin(phi)), np.sum(reach * np.cos(phi))])

    state = np.concatenate([theta, rate])[None]
    kinetic, potential = (
        np.subtract(*pair) for pair in zip(energies(state, Model(loaded)), energies(state, Model(p)), strict=True)
    )
    speed = differences(tip, theta) @ rate
    up = -np.array([-np.sin(p.hang_angle[0]), np.cos(p.hang_angle[0])])
    np.testing.assert_allclose(kinetic, 0.3 * speed @ speed / 2, rtol=1e-9)
    np.testing.assert_allclose(potential, 0.3 * p.gravity * (up @ tip(theta)), rtol=1e-9)
