"""The chain of single joints: the arm itself where joints bend alike; finite differences where they do not.

Cables likewise: as long as their lines through the discs.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from continuum_laws.samples import arm_of as plain_arm
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum.arm import Arm
from continuum.kinematics.cable_lines import cable_lines
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.discs import arm_disc_poses, even_bends
from continuum.kinematics.joint_chain import (
    joint_chain,
    length_rates_of_joints,
    lengths_of_joints,
    tip_pose,
    tip_twist,
)
from continuum.kinematics.routing import section_length_rates, section_lengths

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


@LAW
@given(st.integers(1, 6), st.integers(0, 10**6))
def test_lengths_of_joints_that_bend_alike_are_those_of_the_section(n: int, seed: int) -> None:
    arm, random = arm_of(n), np.random.default_rng(seed)
    w, w_rate = random.normal(0, 0.7, (n, 2)), random.normal(0, 1.0, (n, 2))
    for i, section in enumerate(arm.sections):
        bends, rates = even_bends(w[i], section), even_bends(w_rate[i], section)
        np.testing.assert_allclose(lengths_of_joints(bends, arm, i), section_lengths(w[i], arm, i), atol=1e-14)
        expected = section_length_rates(w[i], w_rate[i], arm, i)
        np.testing.assert_allclose(length_rates_of_joints(bends, rates, arm, i), expected, atol=1e-13)


@LAW
@given(st.integers(1, 6), st.integers(0, 10**6))
def test_lengths_of_joints_are_those_of_the_lines_through_the_discs(n: int, seed: int) -> None:
    bends, _ = drawn(n, seed)
    lines = cable_lines(bends, arm_of(n))
    for i in range(n):
        pieces = [np.linalg.norm(np.diff(line.points, axis=0), axis=1) for line in lines if line.section == i]
        np.testing.assert_allclose(lengths_of_joints(bends[i], arm_of(n), i), np.sum(pieces, axis=1), atol=1e-13)


@LAW
@given(st.integers(1, 6), st.integers(0, 10**6))
def test_length_rates_of_joints_are_derivatives(n: int, seed: int) -> None:
    bends, rates = drawn(n, seed)
    step = 1e-5
    for i in range(n):
        ahead, behind = (lengths_of_joints(bends[i] + side * step * rates[i], arm_of(n), i) for side in (1, -1))
        found = length_rates_of_joints(bends[i], rates[i], arm_of(n), i)
        np.testing.assert_allclose(found, (ahead - behind) / (2 * step), atol=1e-9)
