"""Forward kinematics of the URDF against the library's, and discs that do not twist."""

from dataclasses import replace

import numpy as np
import pytest
from description_model import SHIPPED_ARMS, Description, arms, random_posture, shipped_name
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum.arm import Arm, load_arm
from continuum.kinematics.chain import section_tip_poses
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.section import section_pose

pytestmark = pytest.mark.slow

TOLERANCE = 1e-9


@pytest.fixture(scope="module", params=SHIPPED_ARMS, ids=shipped_name)
def shipped(request: pytest.FixtureRequest) -> Description:
    return Description(load_arm(request.param))


def assert_tips_equal_library(description: Description, phi: np.ndarray, theta: np.ndarray) -> None:
    description.move(phi, theta)
    expected = section_tip_poses(allen_from_jones(phi, theta), description.arm)
    for section, pose in zip(description.arm.sections, expected, strict=True):
        np.testing.assert_allclose(description.pose(section.tip_frame), pose, rtol=0, atol=TOLERANCE)


@settings(max_examples=15, deadline=None)
@given(arms(), st.integers(0, 2**32 - 1))
def test_tips_of_any_arm(arm: Arm, seed: int) -> None:
    assert_tips_equal_library(Description(arm), *random_posture(arm, np.random.default_rng(seed)))


def test_disc_k_is_the_tip_of_a_section_of_k_joints(shipped: Description) -> None:
    phi, theta = random_posture(shipped.arm, np.random.default_rng(7))
    shipped.move(phi, theta)
    for i, section in enumerate(shipped.arm.sections):
        base = np.linalg.inv(shipped.pose(section.base_frame))
        for k, frame in enumerate(shipped.disc_frames(section), start=1):
            part = k / section.n_joints
            shorter = replace(section, n_joints=k, bend_limit=part * section.bend_limit)
            expected = section_pose(allen_from_jones(phi[i], part * theta[i]), shorter)
            np.testing.assert_allclose(base @ shipped.pose(frame), expected, rtol=0, atol=TOLERANCE)


def test_cable_holes_are_at_radius_and_azimuth_of_the_cables(shipped: Description) -> None:
    for section in shipped.arm.sections:
        expected = [[section.a * np.cos(azimuth), section.a * np.sin(azimuth), 0] for azimuth in section.cable_azimuths]
        for frame in shipped.disc_frames(section):
            holes = [v for v in shipped.links[frame].visuals if v.material.name == f"{section.name}_hole"]
            np.testing.assert_allclose([hole.origin[:3, 3] for hole in holes], expected, rtol=0, atol=1e-12)
