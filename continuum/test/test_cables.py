"""Eqs. 8, 9, 25, 26: cables of one section are strings between real discs, and tell its configuration."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_slopes, differences
from continuum_laws.rigid_links import section_discs, total_cable_lengths
from continuum_laws.samples import PROTOTYPE, SECTIONS, postures
from continuum_laws.strategies import LAW, sections
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import Arm, Section
from continuum.kinematics.cables import (
    cable_jacobian,
    cable_lengths,
    configuration_cable_jacobian,
    configuration_from_cables,
)
from continuum.kinematics.cables.hole_points import hole_points
from continuum.kinematics.configuration import allen_from_jones, jones_from_allen
from continuum.kinematics.section import section_jacobian, section_pose

each_section = pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)


@each_section
def test_lengths_are_distances_between_the_holes_of_discs(section: Section) -> None:
    w = postures(section, largest=section.contact_bend)
    alone = Arm((section,))
    for phi, theta, lengths in zip(*jones_from_allen(w), cable_lengths(w, section), strict=True):
        distances = total_cable_lengths(np.array([phi]), np.array([theta]), alone)
        np.testing.assert_allclose(lengths, distances, rtol=0, atol=1e-14)


@each_section
def test_hole_points_are_the_holes_of_discs(section: Section) -> None:
    w = postures(section)
    azimuths = np.array(section.cable_azimuths)
    in_disc = np.stack([section.a * np.cos(azimuths), section.a * np.sin(azimuths), 0 * azimuths, 1 + 0 * azimuths])
    for phi, theta, points in zip(*jones_from_allen(w), hole_points(w, section), strict=True):
        holes = np.stack([(disc @ in_disc)[:3].T for disc in section_discs(phi, theta, section)], axis=1)
        np.testing.assert_allclose(points, holes, rtol=0, atol=1e-14)


@each_section
def test_jacobian_is_the_slope_of_the_lengths(section: Section) -> None:
    w = postures(section)
    assert_same_slopes(cable_jacobian(w, section), differences(lambda q: cable_lengths(q, section), w))


def test_jacobian_of_passing_cables_is_their_slope() -> None:
    w, holes = postures(PROTOTYPE), (np.array([0.04, 0.03, 0.01]), np.array([0.3, 2.9, -1.1]))
    analytic = cable_jacobian(w, PROTOTYPE, *holes)
    assert_same_slopes(analytic, differences(lambda q: cable_lengths(q, PROTOTYPE, *holes), w))


@each_section
def test_configuration_to_cables_and_back(section: Section) -> None:
    w = postures(section, largest=section.contact_bend)
    np.testing.assert_allclose(configuration_from_cables(cable_lengths(w, section), section), w, rtol=0, atol=1e-12)


@LAW
@given(section=sections(), phi=st.floats(-np.pi, np.pi), share=st.floats(0.0, 1.0))
def test_any_section_is_found_from_its_cables(section: Section, phi: float, share: float) -> None:
    w = allen_from_jones(phi, share * section.bend_limit)
    np.testing.assert_allclose(configuration_from_cables(cable_lengths(w, section), section), w, rtol=0, atol=1e-12)


@each_section
def test_jacobian_from_cables_is_the_slope(section: Section) -> None:
    lengths = cable_lengths(postures(section, largest=0.9 * section.contact_bend), section)
    numeric = differences(lambda q: configuration_from_cables(q, section), lengths, step=5e-4)
    assert_same_slopes(configuration_cable_jacobian(lengths, section), numeric)


@each_section
def test_rates_to_the_cables_and_back(section: Section) -> None:
    w = postures(section, largest=section.contact_bend)
    back = configuration_cable_jacobian(cable_lengths(w, section), section) @ cable_jacobian(w, section)
    np.testing.assert_allclose(back, np.broadcast_to(np.eye(2), back.shape), rtol=0, atol=1e-11)


@each_section
def test_turning_cables_and_plane_together_changes_nothing(section: Section) -> None:
    phi, theta = jones_from_allen(postures(section))
    azimuths = np.array(section.cable_azimuths)
    turned = cable_lengths(allen_from_jones(phi + 1.1, theta), section, azimuths=azimuths + 1.1)
    np.testing.assert_allclose(turned, cable_lengths(allen_from_jones(phi, theta), section), rtol=0, atol=1e-14)


@each_section
def test_mirrored_cables_in_the_mirrored_plane_are_as_long(section: Section) -> None:
    w = postures(section)
    mirrored = cable_lengths(w * [-1.0, 1.0], section, azimuths=-np.array(section.cable_azimuths))
    np.testing.assert_allclose(mirrored, cable_lengths(w, section), rtol=0, atol=1e-15)


def test_the_cable_on_the_inner_side_is_the_shortest() -> None:
    lengths = cable_lengths(allen_from_jones(np.array([0.0, np.pi / 2]), 1.0), PROTOTYPE)
    np.testing.assert_array_equal(np.argmin(lengths, axis=-1), [0, 1])


def test_four_cables_a_quarter_turn_apart_follow_eq_9() -> None:
    w = postures(PROTOTYPE, largest=5.0)
    l1, l2, l3, l4 = np.moveaxis(cable_lengths(w, PROTOTYPE), -1, 0)
    a, b, n = PROTOTYPE.a, PROTOTYPE.b, PROTOTYPE.n_joints
    phi = np.arctan2(l4 - l2, l3 - l1)
    theta = 2 * n * np.arctan(2 * b * np.hypot(l4 - l2, l3 - l1) / (a * (l1 + l2 + l3 + l4)))
    np.testing.assert_allclose(allen_from_jones(phi, theta), w, rtol=0, atol=1e-12)


@each_section
def test_inconsistent_lengths_are_projected(section: Section) -> None:
    """What no configuration explains is left out, whatever its size; with three cables nothing is inconsistent."""
    azimuths = np.array(section.cable_azimuths)
    basis = np.stack([np.cos(azimuths), np.sin(azimuths), np.ones_like(azimuths)])
    noise = np.random.default_rng(1).normal(size=len(azimuths))
    unexplained = noise - noise @ np.linalg.pinv(basis) @ basis
    w = postures(section, largest=section.contact_bend)
    lengths = cable_lengths(w, section) + 0.01 * unexplained
    np.testing.assert_allclose(configuration_from_cables(lengths, section), w, rtol=0, atol=1e-12)
    assert (np.linalg.norm(unexplained) < 1e-14) == (len(azimuths) == 3)


@each_section
def test_longer_cables_all_alike_and_no_bend_is_straight(section: Section) -> None:
    lengths = np.full(len(section.cable_azimuths), 1.2 * section.length)
    np.testing.assert_allclose(configuration_from_cables(lengths, section), 0.0, atol=1e-13)


@each_section
def test_tension_does_the_work_that_its_forces_on_the_discs_do(section: Section) -> None:
    """Virtual work: sum over the discs of wrench times the disc's Jacobian equals -T d length / dw, cable by cable."""
    w = postures(section, largest=0.99 * section.contact_bend)
    n = section.n_joints
    azimuths = np.array(section.cable_azimuths)
    local = section.a * np.stack([np.cos(azimuths), np.sin(azimuths), np.zeros_like(azimuths)], axis=-1)
    part = [Section("part", k, section.b, section.a, bend_limit=1e-3) for k in range(1, n + 1)]
    poses = [np.broadcast_to(np.eye(4), (*w.shape[:-1], 4, 4))] + [section_pose(w * p.n_joints / n, p) for p in part]
    holes = [pose[..., None, :3, 3] + local @ np.swapaxes(pose[..., :3, :3], -1, -2) for pose in poses]
    work = np.zeros_like(cable_jacobian(w, section))
    for k in range(1, n + 1):
        jacobian = section_jacobian(w * k / n, part[k - 1]) * k / n
        ends = [holes[k - 1]] + ([holes[k + 1]] if k < n else [])
        force = sum((end - holes[k]) / np.linalg.norm(end - holes[k], axis=-1, keepdims=True) for end in ends)
        moment = np.cross(holes[k] - poses[k][..., None, :3, 3], force)
        work = work + np.concatenate([force, moment], axis=-1) @ jacobian
    np.testing.assert_allclose(work, -cable_jacobian(w, section), rtol=0, atol=1e-13)
