"""Eqs. 20 to 22: Jacobians of one section against differences, in every posture."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_derivatives, differences, geometric_jacobian
from continuum_laws.samples import SECTIONS, postures

from continuum.arm import Section
from continuum.kinematics.section import (
    configuration_from_point,
    configuration_from_point_jacobian,
    section_jacobian,
    section_pose,
)

each_section = pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)


@each_section
def test_tip_jacobian_is_the_derivative_of_the_pose(section: Section) -> None:
    w = postures(section)
    analytic, numeric = section_jacobian(w, section), geometric_jacobian(lambda q: section_pose(q, section), w)
    assert_same_derivatives(analytic[..., :3, :], numeric[..., :3, :])
    assert_same_derivatives(analytic[..., 3:, :], numeric[..., 3:, :])


def points_around() -> np.ndarray:
    """Points (n, 3) [m] above, on and below the base plane, near the axis on both sides of the switch to the series."""
    sensitivities = np.array(
        [0.0, 1e-300, 1e-12, 1e-8, 1e-5, 1e-3, 0.05 * (1 - 1e-9), 0.05 * (1 + 1e-9), 0.2, 1.0, 5.0, 1e3]
    )
    up = np.stack([0.6 * sensitivities, -0.8 * sensitivities, np.ones_like(sensitivities)], axis=-1)
    down = up[sensitivities > 0.01] * [1.0, 1.0, -1.0]
    level = np.array([[0.3, 0.4, 0.0], [-1.0, 0.0, 0.0], [0.0, 2.0, 1e-9]])
    around = np.concatenate([up, down, level])
    return np.concatenate([0.2 * around, 5.0 * around])


def test_configuration_from_point_jacobian_is_the_derivative() -> None:
    points = points_around()
    distance = np.linalg.norm(points, axis=-1)
    radius = np.hypot(points[:, 0], points[:, 1])
    step = 0.02 * np.where(points[:, 2] > 0, distance, radius)
    assert_same_derivatives(
        configuration_from_point_jacobian(points), differences(configuration_from_point, points, step)
    )
