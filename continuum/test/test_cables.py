"""Eqs. 8, 9, 25, 26: cables of one section are strings between real discs, and tell its configuration."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_derivatives, differences
from continuum_laws.rigid_links import section_discs, total_cable_lengths
from continuum_laws.samples import SECTIONS, postures

from continuum.arm import Arm, Section
from continuum.kinematics.cables import (
    cable_jacobian,
    cable_lengths,
    configuration_cable_jacobian,
    configuration_from_cables,
    hole_points,
)
from continuum.kinematics.configuration import jones_from_allen

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
def test_jacobian_is_the_derivative_of_the_lengths(section: Section) -> None:
    w = postures(section)
    assert_same_derivatives(cable_jacobian(w, section), differences(lambda q: cable_lengths(q, section), w))


@each_section
def test_configuration_to_cables_and_back(section: Section) -> None:
    w = postures(section, largest=section.contact_bend)
    np.testing.assert_allclose(configuration_from_cables(cable_lengths(w, section), section), w, rtol=0, atol=1e-12)


@each_section
def test_jacobian_from_cables_is_the_derivative(section: Section) -> None:
    lengths = cable_lengths(postures(section, largest=0.9 * section.contact_bend), section)
    numeric = differences(lambda q: configuration_from_cables(q, section), lengths, step=5e-4)
    assert_same_derivatives(configuration_cable_jacobian(lengths, section), numeric)


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
