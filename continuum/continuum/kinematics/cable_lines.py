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
        section: 0-based index of the section that it runs through.
        colour_index: number of the cable among those of its own section, from 0.
        passing: it belongs to a section further out.
        points: its holes from base disc to tip disc (n, 3) [m].
    """

    cable: str
    section: int
    colour_index: int
    passing: bool
    points: Array


def cable_lines(bends: Sequence[Array], arm: Arm) -> list[CableLine]:
    """All cables in all sections that they run through.

    Args:
        bends: for each section those of its joints, (n_joints, 2) [rad]; :func:`~continuum.kinematics.discs.even_bends`
            makes them of a configuration.
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
    """For each section the arrow of Allen's w = (u, v, 0), from the centre of curvature: start and end (2, 3) [m].

    Where joints of a section are bent differently, it is that of a section that is bent as far evenly.

    Args:
        bends: for each section those of its joints, (n_joints, 2) [rad].
        arm: the arm.
        metres_per_radian: length of an arrow for each radian of bend.
        longest_radius: a section that is straighter than this radius of curvature [m] has no arrow: None.
    """
    arrows: list[Array | None] = []
    for section, bent, discs in zip(arm.sections, bends, arm_disc_poses(bends, arm), strict=True):
        arrow = section_arrow(bent.sum(axis=0), section, metres_per_radian, longest_radius)
        arrows.append(None if arrow is None else arrow @ discs[0, :3, :3].T + discs[0, :3, 3])
    return arrows


def section_arrow(w: Array, section: Section, metres_per_radian: float, longest_radius: float) -> Array | None:
    """The arrow of one section at ``w`` (2,) [rad] in its own base frame, (2, 3) [m]; else as `curvature_arrows`."""
    theta = bend(w)
    kappa = curvature(theta, section)
    if kappa * longest_radius <= 1.0:
        return None
    u, v = w
    centre = np.array([v, -u, 0.0]) / (theta * kappa)
    return np.stack([centre, centre + metres_per_radian * np.array([u, v, 0.0])])
