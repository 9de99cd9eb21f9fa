"""The thesis's equations of dynamics as printed, shown wrong or in need of care: see docs/errata.md."""

import numpy as np
import pytest
from dynamics_laws import prototype_model

from continuum.dynamics.planar.cable_lengths import SIDES, chord_jacobian
from continuum.dynamics.planar.cable_torque import link_wrenches, serial_jacobian, turned
from continuum.dynamics.planar.capstan_law import tension_propagation
from continuum.dynamics.planar.springs_and_friction import joint_friction

P = prototype_model().with_values({"capstan_friction": 0.2}).parameters
N = P.n_joints
THETA = np.array([0.3, -0.2, 0.4, 0.1, -0.3])
U = np.array([20.0, 7.0])
WRONG = 1e-2
"""Relative error beyond which a printed form is wrong, and no rounding."""


def test_eq_13_square() -> None:
    """As printed friction is not odd in the rate, and drives the joint on one side."""
    rate = np.linspace(-0.5, 0.5, 101)[:, None] * np.ones(N)

    def printed(w: np.ndarray) -> np.ndarray:
        factor = 1 + P.stribeck_gain * np.exp(-w / P.stribeck_speed) ** 2
        return P.viscous_friction * w + P.coulomb_friction * np.tanh(P.friction_slope * w) * factor

    assert np.abs(printed(rate) + printed(-rate)).max() > WRONG * np.abs(printed(rate)).max()
    assert -printed(np.full(N, -2.0))[0] > 1e3 * P.coulomb_friction[0]  # where dry friction should be Coulomb's
    np.testing.assert_allclose(joint_friction(rate, P), -joint_friction(-rate, P), atol=1e-15)
    np.testing.assert_allclose(joint_friction(np.full(N, 9.0), P), 9 * P.viscous_friction + P.coulomb_friction)


@pytest.mark.parametrize("side", [1, -1])
def test_eq_15_wrap_and_direction(side: int) -> None:
    """Bent to the negative side, or paid out, the printed tension gives the arm power out of friction."""
    theta, rate = side * np.abs(THETA), side * np.ones(N)
    printed = np.exp(-P.capstan_friction * (np.cumsum(theta) - theta / 2))[:, None] * np.ones(2)

    def lost(share: np.ndarray, rate: np.ndarray) -> np.ndarray:
        """Power that the discs take of each cable: put in at the base less what reaches the modules [W]."""
        taken_in = -chord_jacobian(theta, P) * rate[:, None]
        return np.asarray(U * (taken_in.sum(axis=0) - np.sum(share * taken_in, axis=0)))

    assert min(lost(printed, rate).min(), lost(printed, -rate).min()) < -WRONG
    for direction in (rate, -rate):
        assert np.all(lost(tension_propagation(theta, direction, P), direction) > 0)


def test_eq_16_is_right_in_a_frame_that_faces_backwards() -> None:
    """With y of each link towards the base; at the disc's centre, which is the centre of mass of Table 1's links."""
    tensions = np.random.default_rng(1).uniform(5, 20, (N, 2))
    found = link_wrenches(tensions, THETA, P) * np.array([1.0, -1.0, 1.0])
    for i in range(N):
        half, beyond = THETA[i] / 2, (THETA[i + 1] / 2 if i + 1 < N else 0.0)
        s, c, s2, c2, a = np.sin(half), np.cos(half), np.sin(beyond), np.cos(beyond), P.hole_radius[i]
        W = np.array([[s, s, s2, s2], [c, c, -c2, -c2], [a * c, -a * c, -a * c2, a * c2]])
        pulls = np.append(tensions[i], tensions[i + 1] if i + 1 < N else [0.0, 0.0])
        np.testing.assert_allclose(found[i], W @ pulls, rtol=0, atol=1e-12)


def test_eq_17_first_row() -> None:
    """Its last block as printed holds the last joint's lever and axis: not the cables' virtual work at joint 1."""
    angle = np.cumsum(THETA)
    blocks = serial_jacobian(angle, P).reshape(N, 3, N)  # of each link: its wrench's levers at every joint
    wrenches = link_wrenches(np.ones((N, 1)) * U, THETA, P)
    as_derived = np.einsum("iwk,iw->k", blocks, wrenches)
    work = -(chord_jacobian(THETA, P) * U).sum(axis=1)
    np.testing.assert_allclose(as_derived, work, rtol=0, atol=1e-12)
    as_printed = as_derived[0] + (blocks[-1, :, -1] - blocks[-1, :, 0]) @ wrenches[-1]
    assert abs(as_printed - work[0]) > WRONG * np.abs(work).max()


def test_eq_17_is_in_one_frame() -> None:
    """n x r of all links has to be taken in the frame that the wrenches are in; Eq. 16's are in each link's own."""
    angle = np.cumsum(THETA)
    wrenches = link_wrenches(np.ones((N, 1)) * U, THETA, P)
    at = np.zeros(2)
    torque = np.zeros(N)
    joints = []
    for k in range(N):
        joints.append(at)
        along = np.array([np.sin(angle[k]), np.cos(angle[k])])
        disc = at + P.half_spacing[k] * along
        force = turned(wrenches[k : k + 1, :2], angle[k : k + 1])[0]
        for j, joint in enumerate(joints):
            lever = disc - joint
            torque[j] += lever[1] * force[0] - lever[0] * force[1] + wrenches[k, 2]
        at = at + P.joint_spacing[k] * along
    np.testing.assert_allclose(torque, -(chord_jacobian(THETA, P) * U).sum(axis=1), rtol=0, atol=1e-12)
    each_frames = np.einsum("iwk,iw->k", serial_jacobian(np.zeros(N), P).reshape(N, 3, N), wrenches)
    assert np.abs(each_frames - torque).max() > WRONG * np.abs(torque).max()


def test_cable_1_is_on_the_side_of_positive_angles() -> None:
    """The first column of Eq. 16 is the cable whose moment is positive."""
    np.testing.assert_array_equal(SIDES, [1.0, -1.0])
    assert np.all(link_wrenches(np.array([[1.0, 0.0]] * N), np.zeros(N), P)[-1, 2] > 0)
