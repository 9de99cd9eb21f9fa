"""Masses and inertias: Table 1's figures, and bodies that can exist."""

from dataclasses import replace

import numpy as np
import pytest
from description_model import Description, arms, shipped_arms
from hypothesis import given, settings

from continuum.arm import Arm

pytestmark = pytest.mark.slow


def moving_bodies(description: Description) -> dict[str, tuple[float, np.ndarray, np.ndarray]]:
    """Mass [kg], centre of mass (3,) [m] and inertia (3, 3) [kg m2] in base_link, by link, in the straight posture."""
    zeros = np.zeros(description.arm.n_sections)
    description.move(zeros, zeros)
    bodies = {}
    for name, link in description.links.items():
        if link.inertial is not None:
            pose = description.pose(name) @ link.inertial.origin
            rotation = pose[:3, :3]
            inertia = rotation @ link.inertial.inertia @ rotation.T
            bodies[name] = (link.inertial.mass, pose[:3, 3], inertia)
    return bodies


@settings(max_examples=15, deadline=None)
@given(arms())
def test_total_mass_and_bodies_that_can_exist(arm: Arm) -> None:
    description = Description(arm)
    bodies = moving_bodies(description)
    total = sum(section.n_joints * section.link_mass for section in arm.sections)
    assert sum(mass for mass, _, _ in bodies.values()) == pytest.approx(total, rel=1e-12)
    assert bodies.keys() == {joint.child for joint in description.joints.values() if joint.type != "fixed"}
    for mass, _, inertia in bodies.values():
        x, y, z = sorted(np.linalg.eigvalsh(inertia))
        assert min(mass, x) > 0
        assert x + y >= z * (1 - 1e-12)


@pytest.mark.parametrize("arm", shipped_arms(), ids=lambda arm: f"{arm.n_sections}_sections")
def test_every_link_is_that_of_table_1_with_its_centre_of_mass_in_the_disc(arm: Arm) -> None:
    bodies = moving_bodies(Description(arm))
    height = 0.0
    for section in arm.sections:
        for k in range(1, section.n_joints + 1):
            height += 2 * section.b
            here = [body for body in bodies.values() if np.allclose(body[1], [0, 0, height], rtol=0, atol=1e-9)]
            assert sum(mass for mass, _, _ in here) == pytest.approx(section.link_mass, rel=1e-12), k
            across = sum(inertia for _, _, inertia in here)
            np.testing.assert_allclose(np.diag(across)[:2], section.link_inertia, rtol=1e-12)


def test_axial_inertia_of_the_prototype_is_a_cylinder_of_the_holes_radius() -> None:
    arm = next(arm for arm in shipped_arms() if arm.n_sections == 1)
    section = arm.sections[0]
    disc = moving_bodies(Description(arm))[section.tip_frame]
    assert disc[2][2, 2] == pytest.approx(disc[0] * section.a**2 / 2, rel=1e-12)
    flat = replace(section, link_inertia=section.link_mass * section.a**2 / 40)
    disc = moving_bodies(Description(Arm((flat,))))[section.tip_frame]
    assert disc[2][2, 2] == pytest.approx(2 * disc[2][0, 0], rel=1e-12)  # no body has more
