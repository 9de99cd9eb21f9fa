"""Lines and arrows of the markers: they start and end where the arm does, and are as long as the cables."""

import numpy as np
import pytest
from harness import ARM_FILE

from continuum.arm import load_arm
from continuum.kinematics.cable_lines import cable_lines, curvature_arrows
from continuum.kinematics.chain import section_tip_poses
from continuum.kinematics.configuration import arc_length, bend, curvature
from continuum.kinematics.discs import arm_disc_poses, even_bends
from continuum.kinematics.routing import tangle

ARM = load_arm(ARM_FILE)
POSTURES = [np.zeros((3, 2)), np.random.default_rng(1).uniform(-1.5, 1.5, (3, 2))]


def evenly(w):
    return [even_bends(bent, section) for bent, section in zip(w, ARM.sections, strict=True)]


def unevenly(w, seed=2):
    """Bends in the planes of ``w`` that add up to it, differing from joint to joint."""
    shares = np.random.default_rng(seed).dirichlet(np.ones(ARM.sections[0].n_joints), len(w))
    return list(shares[:, :, None] * w[:, None, :])


@pytest.mark.parametrize("w", POSTURES)
def test_lines_of_a_cable_add_up_to_its_length(w):
    lengths = dict.fromkeys(ARM.cable_names, 0.0)
    for line in cable_lines(evenly(w), ARM):
        lengths[line.cable] += np.linalg.norm(np.diff(line.points, axis=0), axis=-1).sum()
    np.testing.assert_allclose(list(lengths.values()), tangle(w, ARM), rtol=1e-12)


@pytest.mark.parametrize("w", POSTURES)
def test_a_passing_cable_goes_on_where_it_left_the_section_before(w):
    ends = {}
    for line in cable_lines(evenly(w), ARM):
        if line.section:
            np.testing.assert_allclose(line.points[0], ends[line.cable], atol=1e-12)
        assert line.passing == (not line.cable.startswith(f"section_{line.section + 1}_"))
        ends[line.cable] = line.points[-1]
    tips = section_tip_poses(w, ARM)
    for section, tip in zip(ARM.sections, tips, strict=True):
        for name in section.cable_names:
            assert np.linalg.norm(ends[name] - tip[:3, 3]) == pytest.approx(section.a)


def test_uneven_bends_move_discs_but_turn_the_tips_alike():
    w = POSTURES[1]
    even, uneven = (arm_disc_poses(bends, ARM) for bends in (evenly(w), unevenly(w)))
    for first, second in zip(even, uneven, strict=True):
        np.testing.assert_allclose(first[-1, :3, :3], second[-1, :3, :3], atol=1e-12)
        assert not np.allclose(first[1:, :3, 3], second[1:, :3, 3], atol=1e-3)


def test_lines_go_through_the_holes_of_unevenly_bent_sections():
    bends = unevenly(POSTURES[1])
    discs = arm_disc_poses(bends, ARM)
    for line in cable_lines(bends, ARM):
        section, poses = ARM.sections[line.section], discs[line.section]
        apart = line.points - poses[:, :3, 3]
        np.testing.assert_allclose(np.linalg.norm(apart, axis=-1), section.a, atol=1e-12)
        in_disc = np.einsum("kji,kj->ki", poses[:, :3, :3], apart)
        np.testing.assert_allclose(in_disc, in_disc[:1].repeat(len(in_disc), axis=0), atol=1e-12)
        np.testing.assert_allclose(in_disc[:, 2], 0.0, atol=1e-12)


def test_arrow_stands_at_the_centre_of_the_arc_and_turns_base_to_tip():
    w = POSTURES[1]
    tips = section_tip_poses(w, ARM)
    bases = np.concatenate([np.zeros((1, 3)), tips[:-1, :3, 3]])
    for i, (start, end) in enumerate(curvature_arrows(evenly(w), ARM, 0.1, 10.0)):
        theta, section = bend(w[i]), ARM.sections[i]
        radius = 1 / curvature(theta, section)
        assert radius * theta == pytest.approx(arc_length(theta, section))
        assert np.linalg.norm(bases[i] - start) == pytest.approx(radius)
        assert np.linalg.norm(tips[i, :3, 3] - start) == pytest.approx(radius)
        turned = np.cross(bases[i] - start, tips[i, :3, 3] - start)
        np.testing.assert_allclose(end - start, 0.1 * theta * turned / np.linalg.norm(turned), atol=1e-12)


def test_straight_section_has_no_arrow():
    assert curvature_arrows(evenly(POSTURES[0]), ARM, 0.1, 10.0) == [None, None, None]
