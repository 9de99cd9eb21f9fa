"""In the plane, the chain in space is the thesis's: Eqs. 12, 16, 17, and its simulation with set-valued friction."""

from dataclasses import replace

import numpy as np
import pytest

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
