"""M, C, G, K and F of Eq. 12: properties of mechanics, and an independent engine of rigid bodies."""

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import moving, prototype_model, random_parameters
from mujoco_chain import Engine

from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.balance import rigid_body_torque
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.rigid_body import coriolis_matrix, gravity_potential, gravity_torque, inertia_matrix
from continuum.dynamics.planar.springs_and_friction import (
    break_away_torque,
    dry_friction,
    joint_friction,
    spring_potential,
    spring_torque,
)

each_size = pytest.mark.parametrize("n", [1, 2, 5, 8])


def cases(n: int, seed: int, count: int = 8) -> list[tuple[Parameters, np.ndarray, np.ndarray, np.ndarray]]:
    """Parameters with joint angles, rates and accelerations."""
    random = np.random.default_rng([seed, n])
    return [
        (random_parameters(random, n), random.normal(size=n), 5 * random.normal(size=n), 50 * random.normal(size=n))
        for _ in range(count)
    ]


@each_size
def test_rate_of_inertia_less_twice_coriolis_is_skew(n: int) -> None:
    for p, theta, rate, _ in cases(n, 2):
        M_rate = differences(lambda t: inertia_matrix(np.cumsum(theta + t * rate), p), [0.0], 1e-3)[..., 0]  # noqa: B023
        C = coriolis_matrix(np.cumsum(theta), np.cumsum(rate), p)
        N = M_rate - 2 * C
        np.testing.assert_allclose(N + N.T, 0, atol=1e-9 * (np.abs(M_rate).max() + np.abs(C).max()))


@each_size
def test_gravity_and_springs_are_derivatives_of_their_potentials(n: int) -> None:
    for p, theta, _, _ in cases(n, 3):
        slope = differences(lambda q: gravity_potential(np.cumsum(q), p), theta)[0]  # noqa: B023
        np.testing.assert_allclose(gravity_torque(np.cumsum(theta), p), slope, rtol=1e-9, atol=1e-12)
        slope = differences(lambda q: np.sum(spring_potential(q, p)), theta)  # noqa: B023
        np.testing.assert_allclose(spring_torque(theta, p), slope, rtol=1e-9, atol=1e-12)


@each_size
def test_rigid_body_terms_are_those_of_an_independent_engine(n: int) -> None:
    for p, theta, rate, acceleration in cases(n, 4):
        engine, angle = Engine(p), np.cumsum(theta)
        M, still, biased = engine.inertia(theta), engine.bias(theta, 0 * theta), engine.bias(theta, rate)
        expected = (
            (inertia_matrix(angle, p), M),
            (gravity_torque(angle, p), still),
            (coriolis_matrix(angle, np.cumsum(rate), p) @ rate, biased - still),
            (rigid_body_torque(Instant(moving(theta, rate, acceleration), np.zeros(2), p)), M @ acceleration + biased),
        )
        for found, theirs in expected:
            scale = np.abs(biased).max() if theirs.ndim == 1 else np.abs(M).max()
            np.testing.assert_allclose(found, theirs, rtol=0, atol=1e-12 * scale)


@each_size
def test_friction_is_odd_and_takes_power(n: int) -> None:
    for p, _, rate, _ in cases(n, 5):
        F = joint_friction(rate, p)
        np.testing.assert_allclose(joint_friction(-rate, p), -F, rtol=1e-14)
        assert np.all(F * rate > 0)


def test_friction_is_that_of_the_thesis() -> None:
    """Eq. 13 at Table 3's values, by hand, at the Stribeck speed."""
    p, speed = prototype_model(1).parameters, np.array([0.2994])
    dry = 0.0413 * (1 + 0.7472 / np.e)
    np.testing.assert_allclose(joint_friction(speed, p), 0.0314 * 0.2994 + dry, rtol=1e-12)
    np.testing.assert_allclose(break_away_torque(p), 0.0413 * 1.7472, rtol=1e-12)
    np.testing.assert_allclose(dry_friction(100 * speed, p), 0.0413, rtol=1e-12)
