"""Discs of joints that bend each by another angle: the library's poses are those of the description's frames."""

import numpy as np
import pytest
from description_model import Description

from continuum.arm import Arm, Section
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.discs import arm_disc_poses

pytestmark = pytest.mark.slow

POSTURES = 200
TOLERANCE = 1e-9


def arm_of(n_sections: int, random: np.random.Generator) -> Arm:
    """Sections of one to seven joints, each of another size and turned about the one before."""
    sections = []
    for k in range(n_sections):
        n_joints, b, a = int(random.integers(1, 8)), random.uniform(0.01, 0.03), random.uniform(0.02, 0.05)
        limit = 0.9 * 2 * n_joints * np.arctan2(b, a)
        sections.append(Section(f"section_{k + 1}", n_joints, b, a, twist=random.uniform(-3.0, 3.0), bend_limit=limit))
    return Arm(tuple(sections))


@pytest.mark.parametrize("n_sections", range(1, 7))
def test_frames_of_discs_are_the_librarys(n_sections: int) -> None:
    """Bases, discs and tips, by the names under which they are published."""
    random = np.random.default_rng(n_sections)
    description = Description(arm_of(n_sections, random), single_bends=True)
    sections = description.arm.sections
    for _ in range(POSTURES // 6 + 1):
        phi = random.uniform(-np.pi, np.pi, n_sections)
        largest = [section.bend_limit / section.n_joints for section in sections]
        thetas = [random.uniform(-most, most, one.n_joints) for one, most in zip(sections, largest, strict=True)]
        description.move_joints(phi, thetas)
        bends = [allen_from_jones(turn, angles) for turn, angles in zip(phi, thetas, strict=True)]
        for section, poses in zip(sections, arm_disc_poses(bends, description.arm), strict=True):
            found = np.array([description.pose(frame) for frame in section.disc_frames])
            np.testing.assert_allclose(poses, found, rtol=0, atol=TOLERANCE)
