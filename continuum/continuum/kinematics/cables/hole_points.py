"""Where the cables of a section run: the holes that each cable passes, from the base disc to the tip disc."""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.cables.eq08_lengths import cable_holes
from continuum.kinematics.discs import disc_poses, even_bends


def hole_points(w: Array, section: Section, a: Array | None = None, azimuths: Array | None = None) -> Array:
    """Holes (..., n_cables, n_joints + 1, 3) [m] in the section's base frame at ``w`` (..., 2) [rad].

    Between two discs a cable is straight, so the segments between its holes add up to its length of Eq. 8.

    Arguments are those of :func:`~continuum.kinematics.cables.eq08_lengths.cable_lengths`.
    """
    return holes_of_discs(disc_poses(even_bends(w, section), section), *cable_holes(section, a, azimuths))


def holes_of_discs(discs: Array, a: Array, azimuths: Array) -> Array:
    """Holes (..., n_cables, n_discs, 3) [m] in discs at the poses (..., n_discs, 4, 4) [m].

    Args:
        discs: poses of the discs.
        a: radius of each cable's holes, (n_cables,) [m].
        azimuths: azimuth of each cable in the section's frame, (n_cables,) [rad].
    """
    in_disc = np.stack([a * np.cos(azimuths), a * np.sin(azimuths), np.zeros_like(azimuths)], axis=-1)
    points: Array = in_disc @ np.swapaxes(discs[..., :3, :3], -1, -2) + discs[..., None, :3, 3]
    return np.swapaxes(points, -2, -3)
