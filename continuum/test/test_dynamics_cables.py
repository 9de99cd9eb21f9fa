"""J_s, W, B and u of Eqs. 14 to 17: the cables' virtual work, geometry, and their friction on the discs."""

from dataclasses import replace

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import moving, prototype_model, random_parameters

from continuum.arm import Section
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.cable_lengths import SIDES, chord_jacobian, chord_lengths
from continuum.dynamics.planar.cable_torque import cable_torque, serial_jacobian, serial_jacobian_transposed_times
from continuum.dynamics.planar.capstan_law import tension_propagation, wrap_angles
from continuum.kinematics.cables import cable_lengths
from continuum.kinematics.configuration import allen_from_jones

each_size = pytest.mark.parametrize("n", [1, 2, 5, 8])


def cases(n: int, seed: int, count: int = 8) -> list[tuple[Parameters, np.ndarray, np.ndarray, np.ndarray]]:
    """Parameters with joint angles short of where holes meet, rates, and tensions at the base."""
    random = np.random.default_rng([seed, n])
    return [
        (random_parameters(random, n), random.uniform(-0.5, 0.5, n), random.normal(size=n), random.uniform(0, 50, 2))
        for _ in range(count)
    ]


@each_size
def test_torque_of_wrenches_is_the_transposed_serial_jacobian(n: int) -> None:
    random = np.random.default_rng(n)
    for p, theta, _, _ in cases(n, 2):
        wrenches, angle = random.normal(size=(n, 3)), np.cumsum(theta)
        torque = serial_jacobian(angle, p).T @ wrenches.reshape(-1)
        np.testing.assert_allclose(serial_jacobian_transposed_times(wrenches, angle, p), torque, atol=1e-13)


@each_size
def test_cable_torque_is_the_cables_virtual_work(n: int) -> None:
    for p, theta, rate, u in cases(n, 4):
        sensitivities = differences(lambda q: chord_lengths(q, p), theta)  # (n, n_cables, n)  # noqa: B023
        tensions = tension_propagation(theta, rate, p) * u
        work = -np.einsum("ij,ijk->k", tensions, sensitivities)
        np.testing.assert_allclose(
            cable_torque(moving(theta, rate), u, p), work, rtol=0, atol=1e-10 * np.abs(work).max()
        )
        np.testing.assert_allclose(chord_jacobian(theta, p), np.einsum("iji->ij", sensitivities), rtol=0, atol=1e-12)


@each_size
def test_longer_links_change_nothing_of_the_cables_virtual_work(n: int) -> None:
    """A link with two discs: the cable between them pulls them together, which moves no joint."""
    for p, theta, rate, u in cases(n, 6):
        longer = replace(p, link_length=p.joint_spacing + np.random.default_rng(n).uniform(0.0, 0.3, n))
        torque = cable_torque(moving(theta, rate), u, p)
        np.testing.assert_allclose(cable_torque(moving(theta, rate), u, longer), torque, rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("n", [1, 4])
@pytest.mark.parametrize("bend", [-0.9, 0.0, 1e-9, 0.3, 1.2])
def test_chords_add_up_to_the_lengths_of_the_kinematics(n: int, bend: float) -> None:
    """One section of n joints bent in the plane phi = 0, cables at azimuths 0 and pi; a third one is not compared."""
    section = Section(name="s", n_joints=n, b=0.02, a=0.015, cable_azimuths=(0.0, np.pi, 1.0), bend_limit=1.3)
    p = prototype_model(n).parameters
    p = replace(p, half_spacing=np.full(n, section.b), hole_radius=np.full(n, section.a))
    w = allen_from_jones(np.array(0.0 if bend >= 0 else np.pi), np.array(abs(bend)))
    found = chord_lengths(np.full(n, bend / n), p).sum(axis=0)
    np.testing.assert_allclose(found, cable_lengths(w, section)[:2], rtol=1e-13)


def test_a_cable_does_not_push() -> None:
    for p, theta, rate, u in cases(5, 5):
        pulled = cable_torque(moving(theta, rate), u * [1, 0], p)
        np.testing.assert_array_equal(cable_torque(moving(theta, rate), np.array([u[0], -7.0]), p), pulled)
        np.testing.assert_array_equal(cable_torque(moving(theta, rate), np.array([-1.0, -7.0]), p), np.zeros(5))


@pytest.mark.parametrize("cable", [0, 1])
def test_losses_are_as_printed_where_the_arm_bends_one_way_and_the_cable_is_taken_in(cable: int) -> None:
    """Eq. 15: T_i = u exp(-mu_c (theta_1 + ... + theta_(i-1) + theta_i / 2))."""
    random, side = np.random.default_rng(6), SIDES[cable]
    p = replace(random_parameters(random, 5), cable_slope=np.array([1e6]))
    theta, rate = side * random.uniform(0.05, 0.5, 5), side * random.uniform(0.5, 2.0, 5)
    printed = np.exp(-p.capstan_friction * (np.cumsum(np.abs(theta)) - np.abs(theta) / 2))
    np.testing.assert_allclose(tension_propagation(theta, rate, p)[:, cable], printed, rtol=1e-12)
    paid_out = tension_propagation(theta, -rate, p)[:, cable]
    np.testing.assert_allclose(paid_out, 1 / printed, rtol=1e-12)  # rises towards the tip
    assert np.all(np.diff(paid_out) > 0)


def test_wrap_is_the_angle_between_neighbouring_chords() -> None:
    """The chord of module i leans by half its joint's angle from both of its links."""
    theta = np.array([0.4, 0.2, -0.3, -0.1, 0.3])
    leans = np.concatenate([[0.0], np.cumsum(theta) - theta / 2])  # before the base plate the cable is straight
    np.testing.assert_allclose(wrap_angles(theta), np.abs(np.diff(leans)), rtol=1e-14)


@each_size
def test_friction_on_the_discs_takes_power(n: int) -> None:
    """What is put in at the base, u times the speed taken in, is never less than what reaches the modules."""
    for p, theta, rate, u in cases(n, 7, count=30):
        taken_in = -chord_jacobian(theta, p) * rate[:, None]
        lost = u * taken_in.sum(axis=0) - np.sum(tension_propagation(theta, rate, p) * u * taken_in, axis=0)
        assert np.all(lost >= -1e-12)
        assert np.any(lost > 1e-9)
