"""The thesis's equations as printed, shown wrong or in need of care, and as they should be: see docs/errata.md."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_derivatives, differences
from continuum_laws.rigid_links import section_discs, total_cable_lengths
from continuum_laws.samples import PROTOTYPE

from continuum.arm import Arm
from continuum.kinematics.cables import cable_jacobian, cable_lengths, configuration_from_cables
from continuum.kinematics.configuration import (
    allen_from_jones,
    allen_rate_jacobian,
    arc_length,
    arc_rates,
    bend,
    curvature,
    jones_from_allen,
)
from continuum.kinematics.section import (
    configuration_from_point,
    configuration_from_point_jacobian,
    jones_from_point_jacobian,
    section_pose,
    spatial_twist_jacobian,
)

N, A, B = PROTOTYPE.n_joints, PROTOTYPE.a, PROTOTYPE.b
PHI, THETA = np.array([0.3, -1.2, 2.0, 3.0]), np.array([0.4, 1.3, 2.2, 3.6])
W = allen_from_jones(PHI, THETA)
ALPHA = np.array(PROTOTYPE.cable_azimuths)
WRONG = 1e-2
"""Relative error beyond which a printed form is wrong, and no rounding."""


def pose_of(q: np.ndarray) -> np.ndarray:
    return section_pose(allen_from_jones(q[..., 0], q[..., 1]), PROTOTYPE)


def module_length(q: np.ndarray, azimuths: np.ndarray = ALPHA, a: float = A) -> np.ndarray:
    """Distance of the cables' holes on two neighbouring discs [m], from the discs themselves; q = (phi, theta)."""
    first = [section_discs(phi, theta, PROTOTYPE)[1] for phi, theta in np.reshape(q, (-1, 2))]
    holes = np.stack([a * np.cos(azimuths), a * np.sin(azimuths), 0 * azimuths, 1 + 0 * azimuths])
    return np.linalg.norm((np.array(first) @ holes - holes)[:, :3], axis=1).reshape(*q.shape[:-1], len(azimuths))


def relative_error(found: np.ndarray, exact: np.ndarray) -> float:
    return float(np.max(np.abs(found - exact)) / np.max(np.abs(exact)))


def rotation_of_eq_4(first_entry: np.ndarray) -> np.ndarray:
    u, v = W[:, 0], W[:, 1]
    gamma, xi = (np.cos(THETA) - 1) / THETA**2, np.sin(THETA) / THETA
    rows = [
        [first_entry, -gamma * u * v, xi * v],
        [-gamma * u * v, gamma * u**2 + 1, -xi * u],
        [-xi * v, xi * u, np.cos(THETA)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def test_eq_04_first_entry() -> None:
    v = W[:, 1]
    printed = rotation_of_eq_4(np.sin(THETA) / THETA * v**2 + 1)
    corrected = rotation_of_eq_4((np.cos(THETA) - 1) / THETA**2 * v**2 + 1)
    identity = np.broadcast_to(np.eye(3), (4, 3, 3))
    assert relative_error(printed @ np.swapaxes(printed, 1, 2), identity) > WRONG
    np.testing.assert_allclose(corrected @ np.swapaxes(corrected, 1, 2), identity, rtol=0, atol=1e-14)
    np.testing.assert_allclose(section_pose(W, PROTOTYPE)[:, :3, :3], corrected, rtol=0, atol=1e-14)


def bend_of_eq_5(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    radius = np.hypot(x, y)
    kappa = 2 * radius / (x**2 + y**2 + z**2)
    inverse_cosine = np.arccos(np.clip(1 - kappa * radius, -1.0, 1.0))
    return np.where(z > 0, inverse_cosine, 2 * np.pi - inverse_cosine)


def test_eq_05_case_split() -> None:
    """The same map where both are regular; near the straight posture the printed one loses half the digits."""
    tip = section_pose(W, PROTOTYPE)[:, :3, 3]
    np.testing.assert_allclose(bend_of_eq_5(*tip.T), bend(configuration_from_point(tip)), rtol=0, atol=1e-12)
    nearly_straight = np.array([1e-9, 0.0, 0.2])
    assert relative_error(bend_of_eq_5(*nearly_straight), np.array(1e-8)) > WRONG
    assert relative_error(bend(configuration_from_point(nearly_straight)), np.array(1e-8)) < 1e-15


def test_eq_05_is_a_projection() -> None:
    """Its curvature is that of the circle through the point, Eq. 7's only if the inextensible section reaches it."""
    for factor, agrees in ((1.0, True), (0.8, False)):
        x, y, z = factor * section_pose(W, PROTOTYPE)[:, :3, 3].T
        kappa = 2 * np.hypot(x, y) / (x**2 + y**2 + z**2)
        exact = curvature(bend(configuration_from_point(np.stack([x, y, z], axis=-1))), PROTOTYPE)
        assert (relative_error(kappa, exact) < 1e-12) == agrees


def test_eq_06_straight() -> None:
    with np.errstate(invalid="ignore"):
        printed = B * np.array(0.0) / np.tan(np.array(0.0))
    assert np.isnan(printed)
    assert arc_length(np.array(0.0), PROTOTYPE) == pytest.approx(2 * N * B, rel=1e-15)


def test_eq_08_is_one_module() -> None:
    """With the whole section's transform it is the distance of its end discs' holes, not the length of a cable."""
    holes = np.stack([A * np.cos(ALPHA), A * np.sin(ALPHA), 0 * ALPHA, 1 + 0 * ALPHA])
    whole = np.linalg.norm((section_pose(W, PROTOTYPE) @ holes - holes)[:, :3], axis=1)
    alone = Arm((PROTOTYPE,))
    exact = np.array([total_cable_lengths(p[None], t[None], alone) for p, t in zip(PHI, THETA, strict=True)])
    module = module_length(np.stack([PHI, THETA], axis=-1))
    assert relative_error(whole, exact) > WRONG
    assert relative_error(module, exact) > WRONG
    np.testing.assert_allclose(N * module, exact, rtol=1e-13)
    np.testing.assert_allclose(cable_lengths(W, PROTOTYPE), exact, rtol=1e-13)


def test_eq_08_sign() -> None:
    """Beyond the bend at which the holes meet, the printed norm folds back; the signed chord goes on smoothly."""
    beyond = np.array([[0.0, 1.1 * PROTOTYPE.contact_bend]])
    signed = N * 2 * (B * np.cos(beyond[:, 1] / (2 * N)) - A * np.sin(beyond[:, 1] / (2 * N)))
    lengths = cable_lengths(allen_from_jones(beyond[:, 0], beyond[:, 1]), PROTOTYPE)[:, 0]
    assert signed < 0
    np.testing.assert_allclose(N * module_length(beyond)[:, 0], -signed, rtol=1e-12)
    np.testing.assert_allclose(lengths, signed, rtol=1e-12)


def curvature_of_eq_9(lengths: np.ndarray) -> np.ndarray:
    l1, l2, l3, l4 = np.moveaxis(lengths, -1, 0)
    across = np.hypot(l4 - l2, l3 - l1)
    return (l1 - 3 * l2 + l3 + l4) * across / (A * (l1 + l2 + l3 + l4) * (l4 - l2))


def curvature_corrected(lengths: np.ndarray) -> np.ndarray:
    l1, l2, l3, l4 = np.moveaxis(lengths, -1, 0)
    return 2 * np.hypot(l4 - l2, l3 - l1) / (A * (l1 + l2 + l3 + l4))


def test_eq_09_removable_singularity() -> None:
    lengths, exact = cable_lengths(W, PROTOTYPE), curvature(THETA, PROTOTYPE)
    np.testing.assert_allclose(curvature_of_eq_9(lengths), exact, rtol=1e-12)
    np.testing.assert_allclose(curvature_corrected(lengths), exact, rtol=1e-12)
    in_plane = np.array([0.04, 0.05, 0.06, 0.05])  # l4 = l2: bent towards the first cable
    with np.errstate(divide="ignore", invalid="ignore"):
        assert not np.isfinite(curvature_of_eq_9(in_plane))
    np.testing.assert_allclose(
        curvature_corrected(in_plane), curvature(bend(configuration_from_cables(in_plane, PROTOTYPE)), PROTOTYPE)
    )


def test_eq_09_inconsistent_lengths() -> None:
    """Measured lengths: numbering the same cables from another one must not change the curvature."""
    measured = cable_lengths(W, PROTOTYPE) + 1e-3 * np.array([1.0, 0.0, 0.0, 0.0])
    renumbered = np.roll(measured, 1, axis=-1)
    assert relative_error(curvature_of_eq_9(renumbered), curvature_of_eq_9(measured)) > WRONG
    np.testing.assert_allclose(curvature_corrected(renumbered), curvature_corrected(measured), rtol=1e-14)
    found = curvature(bend(configuration_from_cables(measured, PROTOTYPE)), PROTOTYPE)
    np.testing.assert_allclose(found, curvature_corrected(measured), rtol=1e-12)


def test_eq_09_arctangent() -> None:
    kappa = curvature(THETA, PROTOTYPE)
    with pytest.raises(TypeError):
        np.arctan2(kappa * B)
    np.testing.assert_allclose(2 * N / kappa * np.arctan(kappa * B), arc_length(THETA, PROTOTYPE), rtol=1e-13)


def twist_of_eq_21(third_denominator: np.ndarray) -> np.ndarray:
    """The matrix of Eq. 21 as printed, but for the denominator of its entry (3, theta)."""
    cp, sp, ct, st = np.cos(PHI), np.sin(PHI), np.cos(THETA), np.sin(THETA)
    lever = B * (ct - 1) / np.tan(THETA / (2 * N))
    lateral = -B * (ct - 1) / (N * (np.cos(THETA / N) - 1))
    rise = -B / (2 * N) * (st - N * np.sin(THETA / N)) / third_denominator
    zero = np.zeros(4)
    rows = [
        [-lever * sp, lateral * cp],
        [lever * cp, lateral * sp],
        [zero, rise],
        [-st * cp, -sp],
        [-st * sp, cp],
        [1 - ct, zero],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def twist_of_eq_20() -> np.ndarray:
    """(dT / dq T^-1) as a twist, by differences of the pose."""
    q = np.stack([PHI, THETA], axis=-1)
    twists = np.einsum("nijk,njl->nilk", differences(pose_of, q), np.linalg.inv(pose_of(q)))
    return np.stack([twists[:, i, j, :] for i, j in ((0, 3), (1, 3), (2, 3), (2, 1), (0, 2), (1, 0))], axis=1)


def test_eq_21_third_row() -> None:
    exact = twist_of_eq_20()
    printed = twist_of_eq_21(np.sin(THETA / N) ** 2)
    corrected = twist_of_eq_21(np.sin(THETA / (2 * N)) ** 2)
    assert relative_error(printed[:, 2], exact[:, 2]) > WRONG
    assert_same_derivatives(corrected, exact)
    assert_same_derivatives(spatial_twist_jacobian(PHI, THETA, PROTOTYPE), exact)


def test_eq_21_all_other_entries_are_right() -> None:
    others = [0, 1, 3, 4, 5]
    assert_same_derivatives(twist_of_eq_21(np.sin(THETA / N) ** 2)[:, others], twist_of_eq_20()[:, others])


def test_eq_21_is_no_tip_velocity() -> None:
    """A spatial twist: its linear part belongs to the point at the base's origin, not to the tip."""
    q = np.stack([PHI, THETA], axis=-1)
    tip = differences(lambda q: pose_of(q)[..., :3, 3], q)
    exact = twist_of_eq_20()
    assert relative_error(exact[:, :3], tip) > WRONG
    at_tip = exact[:, :3] + np.cross(exact[:, 3:], pose_of(q)[:, :3, 3, None], axisa=1, axisb=1, axisc=1)
    assert_same_derivatives(at_tip, tip)


def test_eq_22_is_right_but_on_the_axis() -> None:
    """Right also where z <= 0, which the thesis leaves out; not finite on the axis."""
    points = np.array([[0.1, 0.05, 0.15], [-0.05, 0.1, 0.0], [0.03, -0.1, -0.1]])
    numeric = differences(lambda p: np.stack(jones_from_allen(configuration_from_point(p)), axis=-1), points, 1e-3)
    assert_same_derivatives(jones_from_point_jacobian(points), numeric)
    on_axis = np.array([0.0, 0.0, 0.2])
    assert not np.all(np.isfinite(jones_from_point_jacobian(on_axis)))
    slope = differences(configuration_from_point, on_axis, 1e-3)
    assert_same_derivatives(configuration_from_point_jacobian(on_axis), slope)


def test_eq_23_is_right() -> None:
    numeric = differences(lambda q: allen_from_jones(q[..., 0], q[..., 1]), np.stack([PHI, THETA], axis=-1))
    assert_same_derivatives(allen_rate_jacobian(PHI, THETA), numeric)


def test_eq_24_curvature() -> None:
    kappa = curvature(THETA, PROTOTYPE)
    exact = differences(lambda q: curvature(q[..., 0], PROTOTYPE), THETA[:, None])[:, 0]
    assert relative_error(kappa / (2 * N) + 1 / (2 * B * N), exact) > WRONG
    np.testing.assert_allclose(kappa**2 * B / (2 * N) + 1 / (2 * B * N), exact, rtol=1e-9)
    np.testing.assert_allclose(arc_rates(THETA, 1.0, PROTOTYPE)[0], exact, rtol=1e-9)


def test_eq_24_arc_length_is_right_but_when_straight() -> None:
    exact = differences(lambda q: arc_length(q[..., 0], PROTOTYPE), THETA[:, None])[:, 0]
    kappa, s = curvature(THETA, PROTOTYPE), arc_length(THETA, PROTOTYPE)
    np.testing.assert_allclose(1 / kappa - s / (N * np.sin(THETA / N)), exact, rtol=1e-9)
    small = np.array([1e-9])
    printed = 1 / curvature(small, PROTOTYPE) - arc_length(small, PROTOTYPE) / (N * np.sin(small / N))
    slope = -B * 2 * small / (3 * 2 * N)  # of s = 2 n b (1 - x^2 / 3), x = theta / (2 n)
    assert relative_error(printed, slope) > WRONG
    assert relative_error(arc_rates(small, 1.0, PROTOTYPE)[1], slope) < 1e-12


@pytest.fixture
def lengths_and_derivatives() -> tuple[np.ndarray, np.ndarray]:
    """Lengths (4, 4) [m] of one module's cables and their derivatives (4, 4, 2) by (phi, theta), from the discs."""
    q = np.stack([PHI, THETA], axis=-1)
    return module_length(q), differences(module_length, q)


def test_eq_25_left_side(lengths_and_derivatives: tuple[np.ndarray, np.ndarray]) -> None:
    """d l / d phi = (d l^2 / d phi) / 2l; printed with d l^2 / d phi on both sides."""
    lengths, exact = lengths_and_derivatives
    squares = differences(lambda q: module_length(q) ** 2, np.stack([PHI, THETA], axis=-1))
    right_side = squares / (2 * lengths[..., None])
    assert relative_error(right_side, squares) > WRONG
    assert_same_derivatives(right_side, exact)


def derivative_of_eq_26(lengths: np.ndarray, sine_power: int) -> np.ndarray:
    """Entry d l / d phi of Eq. 26, with sin(theta / 2n) to the power 1 as printed, or 2."""
    apart = PHI[:, None] - ALPHA
    x = THETA[:, None] / (2 * N)
    return 4 * A * np.sin(apart) * (B * np.sin(2 * x) - 2 * A * np.sin(x) ** sine_power * np.cos(apart)) / (2 * lengths)


def test_eq_26_missing_square(lengths_and_derivatives: tuple[np.ndarray, np.ndarray]) -> None:
    lengths, exact = lengths_and_derivatives
    assert relative_error(derivative_of_eq_26(lengths, 1), exact[..., 0]) > WRONG
    np.testing.assert_allclose(derivative_of_eq_26(lengths, 2), exact[..., 0], rtol=1e-9, atol=1e-12)


def test_eq_26_second_entry_is_right(lengths_and_derivatives: tuple[np.ndarray, np.ndarray]) -> None:
    lengths, exact = lengths_and_derivatives
    c, sin, cos = np.cos(PHI[:, None] - ALPHA), np.sin(THETA / N)[:, None], np.cos(THETA / N)[:, None]
    printed = 2 / N * (A**2 * sin * c**2 - B**2 * sin - 2 * A * B * cos * c) / (2 * lengths)
    np.testing.assert_allclose(printed, exact[..., 1], rtol=1e-9, atol=1e-12)


def test_eq_26_is_one_module(lengths_and_derivatives: tuple[np.ndarray, np.ndarray]) -> None:
    """A section's cable moves n_j times as fast."""
    _, module = lengths_and_derivatives
    section = cable_jacobian(W, PROTOTYPE) @ allen_rate_jacobian(PHI, THETA)
    assert relative_error(module, section) > WRONG
    assert_same_derivatives(N * module, section)


def test_passing_cables_have_their_own_chord() -> None:
    """Taken at the proximal section's own radius and azimuth, a passing cable gets a wrong length."""
    azimuth, a = np.array([0.5]), np.array([0.02])
    exact = N * module_length(np.stack([PHI, THETA], axis=-1), azimuth, a)
    assert relative_error(cable_lengths(W, PROTOTYPE)[:, :1], exact) > WRONG
    np.testing.assert_allclose(cable_lengths(W, PROTOTYPE, a, azimuth), exact, rtol=1e-12)
