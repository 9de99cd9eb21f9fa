"""The arm as the viewer draws it stands where the kinematics says, and its cables are as long as they are."""

import numpy as np
import pytest
from harness import ARM_FILE
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import load_arm
from continuum.errors import InvalidValueError
from continuum.joint_names import theta_joints
from continuum.kinematics.cable_lines import cable_lines
from continuum.kinematics.chain import arm_pose, section_tip_poses
from continuum.kinematics.configuration import allen_from_jones
from continuum.viewer.cable_holes import CableHoles
from continuum.viewer.default_arm import arm_of_joints, default_arm
from continuum.viewer.description import arm_description
from continuum.viewer.link_poses import LinkPoses
from continuum.viewer.link_shapes import link_shapes
from continuum.viewer.section_angles import configuration_of_joints, joints_of

pytestmark = pytest.mark.slow

EXACT = 1e-12


def posture(n_sections, seed=0):
    return np.random.default_rng(seed).uniform(-1.2, 1.2, (n_sections, 2))


@pytest.mark.parametrize("n", [1, 3, 10])
def test_links_stand_where_the_kinematics_says(n):
    arm, w = default_arm(n), posture(n)
    chain = LinkPoses(arm_description(arm))
    poses = chain.poses(chain.angles(joints_of(w, arm)))
    tips = poses[[chain.links.index(section.tip_frame) for section in arm.sections]]
    np.testing.assert_allclose(tips, section_tip_poses(w, arm), atol=EXACT)


@pytest.mark.parametrize("n", [1, 3, 10])
def test_cables_are_the_lines_of_the_markers(n):
    """At the angles that every joint has for itself: those of the description's chain are the library's."""
    arm = default_arm(n)
    chain = LinkPoses(arm_description(arm))
    rng = np.random.default_rng(n)
    phis = rng.uniform(-3.0, 3.0, n)
    thetas = [rng.uniform(-0.3, 0.4, section.n_joints) for section in arm.sections]
    named = {section.phi_joint: phi for section, phi in zip(arm.sections, phis, strict=True)}
    for section, angles in zip(arm.sections, thetas, strict=True):
        named |= dict(zip(section.theta_joints, angles, strict=True))
    poses = chain.poses(chain.angles(named))
    bends = [allen_from_jones(phi, angles) for phi, angles in zip(phis, thetas, strict=True)]
    for passing in (False, True):
        pieces = CableHoles(arm, chain.links, passing).pieces(poses)
        lines = [line for line in cable_lines(bends, arm) if line.passing is passing]
        wanted = [pair for line in lines for pair in zip(line.points, line.points[1:], strict=False)]
        np.testing.assert_allclose(pieces, np.array(wanted).reshape(-1, 2, 3), atol=EXACT)


@pytest.mark.parametrize("n", [1, 3, 10])
def test_equal_shapes_are_sent_once(n):
    chain = LinkPoses(description := arm_description(default_arm(n)))
    shapes = link_shapes(description, chain.links)
    assert len(shapes) == len(
        link_shapes(arm_description(default_arm(2)), LinkPoses(arm_description(default_arm(2))).links)
    )
    seen = {chain.links[i] for shape in shapes for i in shape.links}
    assert seen == set(chain.links) - {section.base_frame for section in default_arm(n).sections}


@given(st.lists(st.tuples(st.floats(-3.1, 3.1), st.floats(1e-6, 3.0)), min_size=1, max_size=10))
def test_joints_and_configurations_are_two_ways_to_say_the_same(sections):
    arm = default_arm(len(sections))
    w = np.array([[-theta * np.sin(phi), theta * np.cos(phi)] for phi, theta in sections])
    np.testing.assert_allclose(configuration_of_joints(joints_of(w, arm), arm), w, atol=1e-9)


def test_usual_arm_is_the_one_of_three_sections():
    np.testing.assert_allclose(
        arm_pose(posture(3), default_arm()), arm_pose(posture(3), load_arm(ARM_FILE)), atol=EXACT
    )
    assert default_arm().cable_names == load_arm(ARM_FILE).cable_names


def test_an_arm_is_known_by_its_joints():
    arm = default_arm(2)
    found = arm_of_joints(name for section in arm.sections for name in section.theta_joints)
    assert [(s.name, s.n_joints) for s in found.sections] == [(s.name, s.n_joints) for s in arm.sections]
    with pytest.raises(InvalidValueError, match="bending joints"):
        arm_of_joints(["elbow"])


@pytest.mark.parametrize("n", [1, 2, 3, 8])
def test_an_arm_of_any_number_of_joints_is_shown(n: int) -> None:
    (section,) = arm_of_joints(theta_joints("s", n)).sections
    assert section.n_joints == n
    assert 0 < section.bend_limit < section.contact_bend
