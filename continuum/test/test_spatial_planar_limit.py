"""In the plane, the chain in space is the thesis's: Eqs. 12 and 14 to 17."""

from dataclasses import replace

import numpy as np
import pytest
from test_spatial_stepping import run

from continuum.dynamics.balance import numpy_state_space
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.planar.cable_torque import cable_torque
from continuum.dynamics.planar.instant import Motion
from continuum.dynamics.planar.rigid_body import coriolis_matrix, gravity_torque, inertia_matrix
from continuum.dynamics.spatial.planar_section import planar_section
from continuum.dynamics.spatial.terms import cable_terms, rigid_body_terms

NONE = np.zeros(1)


@pytest.fixture(params=[0.0, 0.7])
def section(request):
    """The prototype, and one with links of other lengths, rotors, discs apart, that leans."""
    p = load_model("lamecc_prototype.yaml").parameters
    if not request.param:
        return p
    rng = np.random.default_rng(3)
    lengths = p.joint_spacing * rng.uniform(1.0, 1.5, p.n_joints)
    return replace(
        p, link_length=lengths, rotor_inertia=rng.uniform(0.0, 1e-4, 5), hang_angle=np.array([request.param])
    )


def test_equations_are_those_of_the_thesis(section):
    rng = np.random.default_rng(1)
    q, v, a = rng.normal(0.0, 0.3, 5), rng.normal(0.0, 3.0, 5), rng.normal(0.0, 20.0, 5)
    angle, rate = np.cumsum(q), np.cumsum(v)
    torque, M, _, _ = rigid_body_terms(planar_section(section).chain, q, v, a)
    expected = inertia_matrix(angle, section)
    np.testing.assert_allclose(M, expected, rtol=1e-12)
    expected_torque = expected @ a + coriolis_matrix(angle, rate, section) @ v + gravity_torque(angle, section)
    np.testing.assert_allclose(torque, expected_torque, rtol=1e-11)


def test_torque_of_cables_without_friction(section):
    q = np.random.default_rng(2).normal(0.0, 0.3, 5)
    tension = np.array([3.0, 8.0])
    arm = planar_section(section)
    without = replace(section, capstan_friction=NONE)
    move = Motion(q, 0.0 * q, 0.0 * q, NONE, NONE, NONE)
    _, gradient, _ = cable_terms(arm.chain, arm.cables, q)
    np.testing.assert_allclose(-tension @ gradient, cable_torque(move, tension, without), rtol=1e-11)


def test_accelerations_are_those_of_eq_12_with_capstan_friction(section):
    """At slips on the slope of Eq. 15 and beyond it, from the change of the rates in a tiny step.

    Where the discs of a link are apart, a cable that bends to both sides wraps each of them; Eq. 14 takes them for one.
    """
    dry = replace(section, coulomb_friction=np.zeros(5), capstan_friction=np.array([0.4]), cable_slope=np.array([50.0]))
    arm, rng = planar_section(dry), np.random.default_rng(5)
    rates, h = numpy_state_space(Model(dry)), 1e-9
    for speed in (0.05, 0.5, 5.0):
        q, v, tension = rng.normal(0.0, 0.3, 5), rng.normal(0.0, speed, 5), np.array([12.0, 7.0])
        if section.link_length is not None:
            q = abs(q)
        end = run((arm.chain, arm.joints, arm.cables), q, v, h, 1, tension)
        expected = rates(np.concatenate([q, v]), tension)[5:]
        slippery = run((arm.chain, arm.joints, arm.cables._replace(friction=np.zeros(2))), q, v, h, 1, tension)
        scale = abs(expected).max()
        np.testing.assert_allclose((end.v - v) / h, expected, atol=1e-4 * scale)
        assert abs(slippery.v - end.v).max() / h > 1e-3 * scale
