"""Eqs. 1 to 3, 6, 7, 23, 24: Allen's and Jones's coordinates, the arc of a section, and their rates."""

import numpy as np
import pytest
from continuum_laws.differences import differences
from continuum_laws.samples import AZIMUTHS, PROTOTYPE, SECTIONS, bends, postures

from continuum.arm import Section
from continuum.kinematics.configuration import (
    allen_from_jones,
    allen_rates,
    arc_length,
    arc_rates,
    bend,
    curvature,
    jones_from_allen,
    jones_rates,
)


def jones_grid() -> tuple[np.ndarray, np.ndarray]:
    """Azimuths and bends greater than zero, (n,) each."""
    phi, theta = np.meshgrid(AZIMUTHS, bends(PROTOTYPE)[1:])
    return phi.ravel(), theta.ravel()


def test_jones_to_allen_and_back() -> None:
    phi, theta = jones_grid()
    phi_back, theta_back = jones_from_allen(allen_from_jones(phi, theta))
    np.testing.assert_allclose(theta_back, theta, rtol=1e-15)
    np.testing.assert_allclose(np.exp(1j * phi_back), np.exp(1j * phi), rtol=0, atol=1e-15)


def test_allen_to_jones_and_back() -> None:
    w = postures(PROTOTYPE)
    np.testing.assert_allclose(allen_from_jones(*jones_from_allen(w)), w, rtol=0, atol=1e-14)


def test_bend_about_an_axis_goes_to_the_right_side() -> None:
    """A rotation vector along +y takes the tip towards +x, one along +x towards -y."""
    phi, theta = jones_from_allen(np.array([[0.0, 0.3], [0.3, 0.0]]))
    np.testing.assert_allclose(phi, [0.0, -np.pi / 2])
    np.testing.assert_allclose(theta, 0.3)


@pytest.mark.parametrize("u", [0.0, -0.0])
@pytest.mark.parametrize("v", [0.0, -0.0])
def test_azimuth_is_zero_when_straight(u: float, v: float) -> None:
    assert jones_from_allen(np.array([u, v])) == (0.0, 0.0)


@pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)
def test_arc_subtends_the_bend(section: Section) -> None:
    """Eq. 1: theta = s kappa."""
    theta = bends(section)
    np.testing.assert_allclose(arc_length(theta, section) * curvature(theta, section), theta, rtol=1e-13)


def test_jones_rates_undo_allen_rates() -> None:
    phi, theta = jones_grid()
    w_rate = allen_rates(phi, theta, np.full_like(phi, 0.7), np.full_like(phi, -0.2))
    phi_rate, theta_rate = jones_rates(allen_from_jones(phi, theta), w_rate)
    np.testing.assert_allclose(theta_rate, -0.2, rtol=1e-12)
    bent = theta > 1e-200
    np.testing.assert_allclose(
        phi_rate[bent] * np.minimum(theta[bent], 1.0), 0.7 * np.minimum(theta[bent], 1.0), atol=1e-12
    )


def test_jones_rates_are_derivatives_in_time() -> None:
    w = postures(PROTOTYPE)
    w = w[bend(w) > 1e-9]
    w_rate = np.array([0.3, -0.8]) * bend(w)[:, None]
    at = np.zeros((len(w), 1))
    phi_rate, theta_rate = jones_rates(w, w_rate)
    numeric = differences(lambda t: np.stack(jones_from_allen(w + t * w_rate), axis=-1), at)[..., 0]
    away_from_cut = np.abs(np.abs(jones_from_allen(w)[0]) - np.pi) > 0.2
    np.testing.assert_allclose(phi_rate[away_from_cut], numeric[away_from_cut, 0], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(theta_rate / bend(w), numeric[:, 1] / bend(w), rtol=1e-9, atol=1e-9)


def test_a_straight_section_starts_to_bend_with_the_rate() -> None:
    phi_rate, theta_rate = jones_rates(np.zeros(2), np.array([3.0, -4.0]))
    assert (phi_rate, theta_rate) == (0.0, 5.0)


@pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)
def test_arc_rates_are_derivatives(section: Section) -> None:
    theta = bends(section)
    theta = theta[theta < 0.8 * np.pi * section.n_joints]  # the curvature is infinite at pi n_joints
    kappa_rate, s_rate = arc_rates(theta, np.full_like(theta, 2.0), section)
    numeric = differences(
        lambda q: np.stack([curvature(q[..., 0], section), arc_length(q[..., 0], section)], axis=-1),
        theta[:, None],
        step=0.005,
    )[..., 0]
    np.testing.assert_allclose(kappa_rate, 2 * numeric[:, 0], rtol=1e-8)
    np.testing.assert_allclose(s_rate, 2 * numeric[:, 1], rtol=1e-8, atol=1e-11 * section.length)
