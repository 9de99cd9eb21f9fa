"""The chain of single joints: the arm itself where joints bend alike; finite differences where they do not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from continuum_laws.samples import arm_of as plain_arm
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum.arm import Arm
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.discs import arm_disc_poses, even_bends
from continuum.kinematics.joint_chain import joint_chain, tip_pose, tip_twist

LAW = settings(max_examples=40, deadline=None)


def arm_of(n: int) -> Arm:
    """Sections turned about the tip before them, each by another angle."""
    return Arm(tuple(replace(section, twist=0.7 - k) for k, section in enumerate(plain_arm(n).sections)))


def drawn(n: int, seed: int) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Bends of every joint and their rates."""
    random = np.random.default_rng(seed)
    joints = [section.n_joints for section in arm_of(n).sections]
    bends, rates = ([random.normal(0, sd, (count, 2)) for count in joints] for sd in (0.15, 1.0))
    return bends, rates


@LAW
@given(st.integers(1, 6), st.integers(0, 10**6))
def test_joints_that_bend_alike_are_the_section(n: int, seed: int) -> None:
    arm, random = arm_of(n), np.random.default_rng(seed)
    w, w_rate = random.normal(0, 0.7, (n, 2)), random.normal(0, 1.0, (n, 2))
    bends, rates = ([even_bends(x, s) for x, s in zip(each, arm.sections, strict=True)] for each in (w, w_rate))
    np.testing.assert_allclose(tip_pose(bends, joint_chain(arm)), arm_pose(w, arm), atol=1e-12)
    expected = arm_jacobian(w, arm) @ w_rate.reshape(-1)
    np.testing.assert_allclose(tip_twist(bends, rates, joint_chain(arm)), expected, atol=1e-10)


@LAW
@given(st.integers(1, 6), st.integers(0, 10**6))
def test_the_tip_is_the_last_disc(n: int, seed: int) -> None:
    bends, _ = drawn(n, seed)
    np.testing.assert_allclose(
        tip_pose(bends, joint_chain(arm_of(n))), arm_disc_poses(bends, arm_of(n))[-1][-1], atol=1e-12
    )


@LAW
@given(st.integers(1, 6), st.integers(0, 10**6))
def test_the_twist_is_the_rate_of_the_pose(n: int, seed: int) -> None:
    """Central differences of position and rotation."""
    bends, rates = drawn(n, seed)
    chain, step = joint_chain(arm_of(n)), 1e-6
    ahead, behind = (
        tip_pose([b + sign * step * r for b, r in zip(bends, rates, strict=True)], chain) for sign in (1, -1)
    )
    slope = (ahead - behind) / (2 * step)
    turn = slope[:3, :3] @ tip_pose(bends, chain)[:3, :3].T
    found = tip_twist(bends, rates, chain)
    np.testing.assert_allclose(found[:3], slope[:3, 3], atol=1e-7)
    np.testing.assert_allclose(found[3:], [turn[2, 1], turn[0, 2], turn[1, 0]], atol=1e-7)
