"""Eqs. 10 and 11 over the sections: the arm is its links multiplied out, and its Jacobian the slope of its tip."""

import numpy as np
import pytest
from continuum_laws.differences import assert_same_derivatives, geometric_jacobian
from continuum_laws.rigid_links import arm_discs
from continuum_laws.samples import mixed_arm, random_postures
from continuum_laws.strategies import LAW, arms_and_postures
from hypothesis import given

from continuum.arm import Arm
from continuum.kinematics.chain import arm_jacobian, arm_pose, section_base_rotations, section_bases, section_tip_poses
from continuum.kinematics.configuration import jones_from_allen

each_count = pytest.mark.parametrize("n_sections", [1, 2, 3, 5, 7])


@LAW
@given(drawn=arms_and_postures())
def test_every_section_ends_where_its_links_do(drawn: tuple[Arm, np.ndarray]) -> None:
    arm, w = drawn
    discs = arm_discs(*jones_from_allen(w), arm)
    np.testing.assert_allclose(section_tip_poses(w, arm), [part[-1] for part in discs], rtol=0, atol=1e-13)
    np.testing.assert_array_equal(arm_pose(w, arm), section_tip_poses(w, arm)[-1])


@LAW
@given(drawn=arms_and_postures())
def test_base_frames_are_those_of_the_first_discs(drawn: tuple[Arm, np.ndarray]) -> None:
    arm, w = drawn
    first = np.array([part[0] for part in arm_discs(*jones_from_allen(w), arm)])
    bases = first[:, :3, :3]
    np.testing.assert_allclose(section_base_rotations(section_tip_poses(w, arm), arm), bases, rtol=0, atol=1e-13)
    rotations, origins = section_bases(w, arm)
    np.testing.assert_allclose(rotations, bases, rtol=0, atol=1e-13)
    np.testing.assert_allclose(origins, first[:, :3, 3], rtol=0, atol=1e-13)


@each_count
@pytest.mark.parametrize("largest", [0.0, 1e-12, 1e-3, 3.0, 6.0])
def test_jacobian_is_the_derivative_of_the_tip(n_sections: int, largest: float) -> None:
    arm = mixed_arm(n_sections)
    w = random_postures(arm, 5, seed=n_sections, largest=largest)
    w[1::2, n_sections // 2] = 0.0  # one section straight among bent ones
    numeric = geometric_jacobian(
        lambda q: arm_pose(q.reshape((*q.shape[:-1], n_sections, 2)), arm), w.reshape(len(w), 2 * n_sections)
    )
    analytic = arm_jacobian(w, arm)
    assert_same_derivatives(analytic[..., :3, :], numeric[..., :3, :])
    assert_same_derivatives(analytic[..., 3:, :], numeric[..., 3:, :])
