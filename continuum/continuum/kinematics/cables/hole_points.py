"""Where the cables of a section run: the holes that each cable passes, from the base disc to the tip disc."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.cables.eq08_lengths import cable_holes
from continuum.kinematics.section import section_pose


def hole_points(w: Array, section: Section, a: Array | None = None, azimuths: Array | None = None) -> Array:
    """Holes (..., n_cables, n_joints + 1, 3) [m] in the section's base frame at ``w`` (..., 2) [rad].

    The discs stand on the arc of Eq. 4: disc k is the tip of a section with k of the n_j joints.
    Between two discs a cable is straight, so the segments between its holes add up to its length of Eq. 8.

    Arguments are those of :func:`~continuum.kinematics.cables.eq08_lengths.cable_lengths`.
    """
    a, azimuths = cable_holes(section, a, azimuths)
    in_disc = np.stack([a * np.cos(azimuths), a * np.sin(azimuths), np.zeros_like(azimuths)], axis=-1)
    joint = replace(section, n_joints=1, bend_limit=section.bend_limit / section.n_joints)
    step = section_pose(w / section.n_joints, joint)
    disc = np.broadcast_to(np.eye(4), step.shape)
    points = []
    for _ in range(section.n_joints + 1):
        points.append(in_disc @ np.swapaxes(disc[..., :3, :3], -1, -2) + disc[..., None, :3, 3])
        disc = disc @ step
    return np.stack(points, axis=-2)
