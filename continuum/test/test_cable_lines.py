"""Lines and arrows of the markers: they start and end where the arm does, and are as long as the cables."""

import numpy as np
import pytest
from harness import ARM_FILE

from continuum.arm import load_arm
from continuum.kinematics.cable_lines import cable_lines, curvature_arrows
from continuum.kinematics.chain import section_tip_poses
from continuum.kinematics.configuration import arc_length, bend, curvature
from continuum.kinematics.routing import tangle

ARM = load_arm(ARM_FILE)
POSTURES = [np.zeros((3, 2)), np.random.default_rng(1).uniform(-1.5, 1.5, (3, 2))]


@pytest.mark.parametrize("w", POSTURES)
def test_lines_of_a_cable_add_up_to_its_length(w):
    lengths = dict.fromkeys(ARM.cable_names, 0.0)
    for line in cable_lines(w, ARM):
        lengths[line.cable] += np.linalg.norm(np.diff(line.points, axis=0), axis=-1).sum()
    np.testing.assert_allclose(list(lengths.values()), tangle(w, ARM), rtol=1e-12)


@pytest.mark.parametrize("w", POSTURES)
def test_a_passing_cable_goes_on_where_it_left_the_section_before(w):
    ends = {}
    for line in cable_lines(w, ARM):
        if line.section:
            np.testing.assert_allclose(line.points[0], ends[line.cable], atol=1e-12)
        assert line.passing == (not line.cable.startswith(f"section_{line.section + 1}_"))
        ends[line.cable] = line.points[-1]
    tips = section_tip_poses(w, ARM)
    for section, tip in zip(ARM.sections, tips, strict=True):
        for name in section.cable_names:
            assert np.linalg.norm(ends[name] - tip[:3, 3]) == pytest.approx(section.a)


def test_arrow_stands_at_the_centre_of_the_arc_and_turns_base_to_tip():
    w = POSTURES[1]
    tips = section_tip_poses(w, ARM)
    bases = np.concatenate([np.zeros((1, 3)), tips[:-1, :3, 3]])
    for i, (start, end) in enumerate(curvature_arrows(w, ARM, 0.1, 10.0)):
        theta, section = bend(w[i]), ARM.sections[i]
        radius = 1 / curvature(theta, section)
        assert radius * theta == pytest.approx(arc_length(theta, section))
        assert np.linalg.norm(bases[i] - start) == pytest.approx(radius)
        assert np.linalg.norm(tips[i, :3, 3] - start) == pytest.approx(radius)
        turned = np.cross(bases[i] - start, tips[i, :3, 3] - start)
        np.testing.assert_allclose(end - start, 0.1 * theta * turned / np.linalg.norm(turned), atol=1e-12)


def test_straight_section_has_no_arrow():
    assert curvature_arrows(POSTURES[0], ARM, 0.1, 10.0) == [None, None, None]
