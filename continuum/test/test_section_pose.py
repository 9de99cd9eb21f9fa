"""Eqs. 4 and 5: the pose of a section is a rigid motion, that of its links, and is found again from its tip."""

import numpy as np
import pytest
from continuum_laws.rigid_links import section_discs, turn
from continuum_laws.samples import PROTOTYPE, SECTIONS, postures
from continuum_laws.strategies import LAW, sections
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import Section
from continuum.kinematics.configuration import allen_from_jones, arc_length, bend, jones_from_allen
from continuum.kinematics.section import configuration_from_point, section_pose, section_position, section_rotation

each_section = pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)


def test_rotation_is_orthogonal_and_right_handed() -> None:
    rotation = section_rotation(postures(PROTOTYPE))
    np.testing.assert_allclose(
        rotation @ np.swapaxes(rotation, -1, -2), np.broadcast_to(np.eye(3), rotation.shape), atol=2e-15
    )
    np.testing.assert_allclose(np.linalg.det(rotation), 1.0, rtol=1e-14)


def test_rotation_leaves_its_axis_and_turns_by_the_bend() -> None:
    w = postures(PROTOTYPE)
    rotation = section_rotation(w)
    axis = np.append(w, np.zeros((len(w), 1)), axis=-1)
    np.testing.assert_allclose((rotation @ axis[..., None])[..., 0], axis, atol=1e-14)
    np.testing.assert_allclose(np.trace(rotation, axis1=-2, axis2=-1), 1 + 2 * np.cos(bend(w)), atol=1e-14)


def test_bends_about_one_axis_add_up() -> None:
    w = postures(PROTOTYPE)
    np.testing.assert_allclose(section_rotation(0.3 * w) @ section_rotation(0.7 * w), section_rotation(w), atol=1e-14)


@each_section
def test_pose_is_homogeneous(section: Section) -> None:
    pose = section_pose(postures(section), section)
    np.testing.assert_array_equal(pose[..., 3, :], np.broadcast_to([0.0, 0.0, 0.0, 1.0], (*pose.shape[:-2], 4)))


@each_section
def test_pose_is_that_of_the_links(section: Section) -> None:
    """The polygon b, 2b, ..., 2b, b of n_joints revolute joints, multiplied out."""
    w = postures(section)
    for phi, theta, pose in zip(*jones_from_allen(w), section_pose(w, section), strict=True):
        np.testing.assert_allclose(pose, section_discs(phi, theta, section)[-1], rtol=0, atol=1e-14)


@LAW
@given(section=sections(), phi=st.floats(-np.pi, np.pi), theta=st.floats(0.0, 6.5))
def test_pose_of_any_section_is_that_of_its_links(section: Section, phi: float, theta: float) -> None:
    pose = section_pose(allen_from_jones(phi, theta), section)
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
def test_turning_the_bending_plane_turns_the_pose(section: Section) -> None:
    phi, theta = jones_from_allen(postures(section))
    turned = section_pose(allen_from_jones(phi + 0.8, theta), section)
    pose = turn("z", 0.8) @ section_pose(allen_from_jones(phi, theta), section) @ turn("z", -0.8)
    np.testing.assert_allclose(turned, pose, rtol=0, atol=1e-14)


@each_section
def test_mirrored_plane_mirrors_the_pose(section: Section) -> None:
    mirror = np.diag([1.0, -1.0, 1.0, 1.0])
    w = postures(section)
    mirrored = section_pose(w * [-1.0, 1.0], section)
    np.testing.assert_allclose(mirrored, mirror @ section_pose(w, section) @ mirror, rtol=0, atol=1e-15)


@each_section
def test_section_seen_from_its_tip_is_the_same_section(section: Section) -> None:
    """Turned head over heels about x, the section from tip to base is one that bends alike, to the mirrored side."""
    w = postures(section)
    flip = turn("x", np.pi)
    from_tip = flip @ np.linalg.inv(section_pose(w, section)) @ flip
    np.testing.assert_allclose(from_tip, section_pose(w * [-1.0, 1.0], section), rtol=0, atol=1e-14)


@each_section
def test_configuration_to_tip_and_back(section: Section) -> None:
    w = postures(section, largest=min(6.0, 0.95 * np.pi * section.n_joints))
    np.testing.assert_allclose(configuration_from_point(section_position(w, section)), w, rtol=0, atol=1e-12)


def test_point_on_the_disc_plane_and_below_bends_beyond_180_degrees() -> None:
    points = np.array([[0.1, 0.0, 0.0], [0.1, 0.0, -0.1], [0.0, -0.2, -0.001], [0.0, 0.0, 0.3]])
    expected = [np.pi, 1.5 * np.pi, np.pi + 2 * np.arctan(0.005), 0.0]
    np.testing.assert_allclose(bend(configuration_from_point(points)), expected, rtol=1e-14, atol=1e-300)


@given(point=st.tuples(*[st.floats(-1.0, 1.0)] * 3), scale=st.floats(1e-3, 1e3))
@LAW
def test_only_the_direction_of_the_point_is_used(point: tuple[float, float, float], scale: float) -> None:
    near, far = configuration_from_point(np.array(point)), configuration_from_point(scale * np.array(point))
    if np.hypot(*point[:2]) > 1e-290:
        np.testing.assert_allclose(far, near, rtol=1e-13, atol=1e-290)


def test_the_tip_is_seen_in_the_direction_of_the_point() -> None:
    random = np.random.default_rng(3)
    points = random.normal(size=(200, 3))
    seen = section_position(configuration_from_point(points), SECTIONS[-1])
    cosine = np.sum(seen * points, axis=-1) / np.linalg.norm(seen, axis=-1) / np.linalg.norm(points, axis=-1)
    np.testing.assert_allclose(cosine, 1.0, rtol=1e-13)
