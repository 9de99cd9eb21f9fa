"""Eqs. 20 to 22: Jacobians of one section against differences, in every posture."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_slopes, differences, geometric_jacobian
from continuum_laws.samples import PROTOTYPE, SECTIONS, postures

from continuum.arm import Section
from continuum.kinematics.configuration import bend, jones_from_allen
from continuum.kinematics.section import (
    configuration_from_point,
    configuration_from_point_jacobian,
    jones_from_point_jacobian,
    section_jacobian,
    section_pose,
    section_position,
    spatial_twist_jacobian,
)

each_section = pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)


@each_section
def test_tip_jacobian_is_the_slope_of_the_pose(section: Section) -> None:
    w = postures(section)
    analytic, numeric = section_jacobian(w, section), geometric_jacobian(lambda q: section_pose(q, section), w)
    assert_same_slopes(analytic[..., :3, :], numeric[..., :3, :])
    assert_same_slopes(analytic[..., 3:, :], numeric[..., 3:, :])


@each_section
def test_spatial_twist_is_the_slope_times_the_inverse(section: Section) -> None:
    """Eq. 20: (dT / dq T^-1) as a twist, for q = (phi, theta)."""
    phi, theta = jones_from_allen(postures(section))

    def pose(q: np.ndarray) -> np.ndarray:
        return section_pose(np.stack([-q[..., 1] * np.sin(q[..., 0]), q[..., 1] * np.cos(q[..., 0])], axis=-1), section)

    q = np.stack([phi, theta], axis=-1)
    twists = np.einsum("...ijk,...jl->...ilk", differences(pose, q), np.linalg.inv(pose(q)))
    numeric = np.concatenate(
        [twists[..., :3, 3, :], np.stack([twists[..., 2, 1, :], twists[..., 0, 2, :], twists[..., 1, 0, :]], axis=-2)],
        axis=-2,
    )
    analytic = spatial_twist_jacobian(phi, theta, section)
    assert_same_slopes(analytic[..., :3, :], numeric[..., :3, :])
    assert_same_slopes(analytic[..., 3:, :], numeric[..., 3:, :])


def points_around() -> np.ndarray:
    """Points (n, 3) [m] above, on and below the base plane, near the axis on both sides of the switch to the series."""
    slopes = np.array([0.0, 1e-300, 1e-12, 1e-8, 1e-5, 1e-3, 0.05 * (1 - 1e-9), 0.05 * (1 + 1e-9), 0.2, 1.0, 5.0, 1e3])
    up = np.stack([0.6 * slopes, -0.8 * slopes, np.ones_like(slopes)], axis=-1)
    down = up[slopes > 0.01] * [1.0, 1.0, -1.0]
    level = np.array([[0.3, 0.4, 0.0], [-1.0, 0.0, 0.0], [0.0, 2.0, 1e-9]])
    around = np.concatenate([up, down, level])
    return np.concatenate([0.2 * around, 5.0 * around])


def test_configuration_from_point_jacobian_is_the_slope() -> None:
    points = points_around()
    distance = np.linalg.norm(points, axis=-1)
    radius = np.hypot(points[:, 0], points[:, 1])
    step = 0.02 * np.where(points[:, 2] > 0, distance, radius)
    assert_same_slopes(configuration_from_point_jacobian(points), differences(configuration_from_point, points, step))


def test_eq_22_is_the_slope_of_azimuth_and_bend() -> None:
    points = points_around()
    points = points[np.hypot(points[:, 0], points[:, 1]) > 1e-2]
    step = 0.01 * np.hypot(points[:, 0], points[:, 1])
    numeric = differences(lambda p: np.stack(jones_from_allen(configuration_from_point(p)), axis=-1), points, step)
    found = jones_from_point_jacobian(points)
    whole_turn = np.abs(jones_from_allen(configuration_from_point(points))[0]) > 3.0  # atan2 jumps there
    assert_same_slopes(found[:, 1:], numeric[:, 1:])
    assert_same_slopes(found[~whole_turn, :1], numeric[~whole_turn, :1])


@each_section
def test_rates_to_the_tip_and_back(section: Section) -> None:
    """Eq. 5 undoes Eq. 4, so the product of their Jacobians is the identity."""
    w = postures(section, largest=min(5.0, 0.9 * np.pi * section.n_joints))
    back = configuration_from_point_jacobian(section_position(w, section)) @ section_jacobian(w, section)[..., :3, :]
    np.testing.assert_allclose(back, np.broadcast_to(np.eye(2), back.shape), rtol=0, atol=1e-10)


def test_straight_posture_moves_sideways_by_half_the_length() -> None:
    jacobian = section_jacobian(np.zeros(2), PROTOTYPE)
    half = 0.5 * PROTOTYPE.length
    np.testing.assert_allclose(jacobian[:3], [[0, half], [-half, 0], [0, 0]], atol=1e-16)
    np.testing.assert_allclose(jacobian[3:], [[1, 0], [0, 1], [0, 0]], atol=1e-16)


def test_bend_does_not_turn_the_tip_about_the_axis_of_the_base() -> None:
    """Moving within the bending plane, the angular velocity is that of the bend about its axis."""
    w = postures(PROTOTYPE)
    w = w[bend(w) > 0]
    radial = w / bend(w)[:, None]
    angular = (section_jacobian(w, PROTOTYPE)[..., 3:, :] @ radial[..., None])[..., 0]
    np.testing.assert_allclose(angular, np.append(radial, np.zeros((len(w), 1)), axis=-1), atol=1e-14)
