"""Thesis Eq. 16, W: wrench of the cables on each link, at its disc's centre, in its own frame.

A cable pulls a disc backwards along the chord of module i and forwards along that of module i + 1. By symmetry a
chord is parallel to the bisector of its two links, so it leans by half the joint's angle. Compared with the printed
matrix the signs are those of this plane (z along the link, moments from z to x); that J_s^T W B u is the virtual work
of the cables is tested. A link longer than b_i + b_(i+1) has two discs; what pulls at the further one is told at the
nearer one.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.cables import SIDES


def link_wrenches(tensions: Numbers, theta: Numbers, p: Parameters) -> Numbers:
    """W T: (F_x, F_z, M) on each link, (n, 3) [N, N, N m].

    Args:
        tensions: T = B u, of each cable in each module, (n, n_cables) [N].
        theta: of the joints, (n,) [rad].
        p: parameters.
    """
    sine, cosine, a = np.sin(theta / 2), np.cos(theta / 2), p.hole_radius
    pull = tensions.sum(axis=1)
    twist = (tensions * SIDES).sum(axis=1)
    module = np.stack([pull * sine, pull * cosine, twist * a * cosine], axis=1)
    beyond = np.concatenate([module[1:], np.zeros((1, 3))])  # the cables end at the last disc
    further = p.disc_gap * beyond[:, 0]  # a lever longer by the gap
    at_disc = np.stack([np.zeros_like(further), np.zeros_like(further), further], axis=1)
    return module * np.array([1.0, -1.0, 1.0]) + beyond * np.array([1.0, 1.0, -1.0]) + at_disc
