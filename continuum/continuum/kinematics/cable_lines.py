"""Lines of an arm's cables and arrows of its sections' rotation vectors, in ``base_link`` (thesis Fig. 14)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arm import Arm, Section
from continuum.arrays import Array
from continuum.kinematics.cables import holes_of_discs
from continuum.kinematics.configuration import bend, curvature
from continuum.kinematics.discs import arm_disc_poses
from continuum.kinematics.routing import cables_through


@dataclass(frozen=True)
class CableLine:
    """One cable within one section.

    Attributes:
        cable: name of the cable.
        section: 0-based index of the section that this part of the cable runs through.
        colour_index: 0-based number of the cable among those that actuate the same section.
        passing: whether the cable actuates a section further out.
        points: positions of the cable's holes from base disc to tip disc (n, 3) [m].
    """

    cable: str
    section: int
    colour_index: int
    passing: bool
    points: Array


def cable_lines(bends: Sequence[Array], arm: Arm) -> list[CableLine]:
    """Return the lines of all cables in all sections that they run through.

    Args:
        bends: for each section the bends of its joints, (n_joints, 2) [rad];
            :func:`~continuum.kinematics.discs.even_bends` computes them from a configuration.
        arm: the arm.
    """
    colours = {name: j for section in arm.sections for j, name in enumerate(section.cable_names)}
    lines = []
    for i, (section, discs) in enumerate(zip(arm.sections, arm_disc_poses(bends, arm), strict=True)):
        routing = cables_through(arm, i)
        for name, points in zip(routing.names, holes_of_discs(discs, routing.a, routing.azimuths), strict=True):
            lines.append(CableLine(name, i, colours[name], name not in section.cable_names, points))
    return lines


def curvature_arrows(
    bends: Sequence[Array], arm: Arm, metres_per_radian: float, longest_radius: float
) -> list[Array | None]:
    """Return for each section the arrow of Allen's w = (u, v, 0), drawn from the centre of curvature.

    An arrow is its start and end point (2, 3) [m]. Where the joints of a section bend by different angles, the arrow is
    that of an evenly bent section with the same total bend.

    Args:
        bends: for each section the bends of its joints, (n_joints, 2) [rad].
        arm: the arm.
        metres_per_radian: length of an arrow for each radian of bend.
        longest_radius: a section with a radius of curvature above this one [m] has no arrow: None.
    """
    arrows: list[Array | None] = []
    for section, bent, discs in zip(arm.sections, bends, arm_disc_poses(bends, arm), strict=True):
        arrow = section_arrow(bent.sum(axis=0), section, metres_per_radian, longest_radius)
        arrows.append(None if arrow is None else arrow @ discs[0, :3, :3].T + discs[0, :3, 3])
    return arrows


def section_arrow(w: Array, section: Section, metres_per_radian: float, longest_radius: float) -> Array | None:
    """Return the arrow of one section at ``w`` (2,) [rad] in the section's base frame; see `curvature_arrows`."""
    theta = bend(w)
    kappa = curvature(theta, section)
    if kappa * longest_radius <= 1.0:
        return None
    u, v = w
    centre = np.array([v, -u, 0.0]) / (theta * kappa)
    return np.stack([centre, centre + metres_per_radian * np.array([u, v, 0.0])])
