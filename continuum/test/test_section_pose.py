"""Eqs. 4 and 5: the pose of a section is a rigid motion, that of its links, and is found again from its tip."""

import numpy as np
import pytest
from continuum_laws.rigid_links import section_discs
from continuum_laws.samples import SECTIONS, postures

from continuum.arm import Section
from continuum.kinematics.configuration import arc_length, bend, jones_from_allen
from continuum.kinematics.section import configuration_from_point, section_pose, section_position

each_section = pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)


@each_section
def test_pose_is_that_of_the_links(section: Section) -> None:
    """The polygon b, 2b, ..., 2b, b of n_joints revolute joints, multiplied out."""
    w = postures(section)
    for phi, theta, pose in zip(*jones_from_allen(w), section_pose(w, section), strict=True):
        np.testing.assert_allclose(pose, section_discs(phi, theta, section)[-1], rtol=0, atol=1e-14)


@each_section
def test_tip_lies_on_the_arc(section: Section) -> None:
    """Eq. 4's last column with Eq. 6's arc length: s (-v gamma, u gamma, xi)."""
    w = postures(section, largest=min(6.28, 0.9 * np.pi * section.n_joints))
    w = w[bend(w) > 1e-3]
    theta, s = bend(w), arc_length(bend(w), section)
    gamma, xi = (np.cos(theta) - 1) / theta**2, np.sin(theta) / theta
    on_arc = s[:, None] * np.stack([-w[:, 1] * gamma, w[:, 0] * gamma, xi], axis=-1)
    np.testing.assert_allclose(section_position(w, section), on_arc, rtol=0, atol=1e-12 * section.length)


@each_section
def test_configuration_to_tip_and_back(section: Section) -> None:
    w = postures(section, largest=min(6.0, 0.95 * np.pi * section.n_joints))
    np.testing.assert_allclose(configuration_from_point(section_position(w, section)), w, rtol=0, atol=1e-12)


def test_the_tip_is_seen_in_the_direction_of_the_point() -> None:
    random = np.random.default_rng(3)
    points = random.normal(size=(200, 3))
    seen = section_position(configuration_from_point(points), SECTIONS[-1])
    cosine = np.sum(seen * points, axis=-1) / np.linalg.norm(seen, axis=-1) / np.linalg.norm(points, axis=-1)
    np.testing.assert_allclose(cosine, 1.0, rtol=1e-13)
