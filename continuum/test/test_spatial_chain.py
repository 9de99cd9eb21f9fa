"""Rigid bodies and cables in space: equal to MuJoCo's, derivatives as differences, the same in a turned world."""

import mujoco
import numpy as np
import pytest
from spatial_arms import in_mujoco, random_cables, random_chain, rotation

from continuum.dynamics.spatial.terms import cable_terms, rigid_body_terms

ARMS = [(1, 1), (4, 1), (3, 2), (2, 3)]
"""Links, and degrees of freedom of each joint."""


def some_motion(rng: np.random.Generator, n: int):
    return rng.normal(0.0, 0.8, n), rng.normal(0.0, 3.0, n), rng.normal(0.0, 20.0, n)


@pytest.fixture(params=ARMS, ids=str)
def arm(request):
    rng = np.random.default_rng(sum(request.param))
    chain = random_chain(rng, *request.param)
    return rng, chain._replace(rotor=rng.uniform(0.0, 1e-4, chain.mass.size))


def differences(function, x: np.ndarray, step: float) -> np.ndarray:
    """Derivative of a function by x, (.., n), by central differences."""
    columns = [(function(x + e) - function(x - e)) / (2.0 * step) for e in step * np.eye(x.size)]
    return np.stack(columns, axis=-1)


def test_equals_mujoco(arm):
    rng, chain = arm
    q, v, a = some_motion(rng, chain.mass.size)
    model = in_mujoco(chain, None, None)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.qacc[:] = q, v, a
    mujoco.mj_inverse(model, data)
    expected = np.zeros((q.size, q.size))
    mujoco.mj_fullM(model, data, expected)
    torque, M, _, _ = rigid_body_terms(chain, q, v, a)
    np.testing.assert_allclose(M, expected, atol=1e-12 * expected.max())
    np.testing.assert_allclose(torque, data.qfrc_inverse, atol=1e-10 * abs(torque).max())


def test_derivatives_are_those_of_the_torque(arm):
    rng, chain = arm
    q, v, a = some_motion(rng, chain.mass.size)
    torque, M, by_q, by_v = rigid_body_terms(chain, q, v, a)
    for given, found in (
        (differences(lambda x: rigid_body_terms(chain, x, v, a)[0], q, 1e-6), by_q),
        (differences(lambda x: rigid_body_terms(chain, q, x, a)[0], v, 1e-3), by_v),
        (differences(lambda x: rigid_body_terms(chain, q, v, x)[0], a, 1e-1), M),
    ):
        np.testing.assert_allclose(found, given, atol=1e-8 * max(abs(given).max(), abs(torque).max()))


def test_a_turned_world_changes_nothing(arm):
    rng, chain = arm
    q, v, a = some_motion(rng, chain.mass.size)
    turn = rotation(rng.normal(size=3))
    turned = chain._replace(base=turn @ chain.base, gravity=turn @ chain.gravity)
    in_one, in_other = rigid_body_terms(chain, q, v, a), rigid_body_terms(turned, q, v, a)
    for before, after in zip(in_one, in_other, strict=True):
        np.testing.assert_allclose(after, before, atol=1e-12 * max(abs(before).max(), abs(in_one[0]).max()))


def test_cables_equal_mujoco_and_their_gradients_differences(arm):
    rng, chain = arm
    cables = random_cables(rng, chain, 3)
    q = some_motion(rng, chain.mass.size)[0]
    lengths, gradient, _ = cable_terms(chain, cables, q)
    model = in_mujoco(chain, None, cables)
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    np.testing.assert_allclose(lengths, data.ten_length, atol=1e-13)
    by_differences = differences(lambda x: cable_terms(chain, cables, x)[0], q, 1e-6)
    np.testing.assert_allclose(gradient, by_differences, atol=1e-8)
