"""Lines of an arm's cables and arrows of its sections' rotation vectors, in ``base_link`` (thesis Fig. 14)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arm import Arm, Section
from continuum.arrays import Array
from continuum.kinematics.cables.hole_points import hole_points
from continuum.kinematics.chain import section_bases
from continuum.kinematics.configuration import bend, curvature
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


def cable_lines(w: Array, arm: Arm) -> list[CableLine]:
    """All cables in all sections that they run through, at ``w`` (n_sections, 2) [rad]."""
    rotations, origins = section_bases(w, arm)
    colours = {name: j for section in arm.sections for j, name in enumerate(section.cable_names)}
    lines = []
    for i, section in enumerate(arm.sections):
        routing = cables_through(arm, i)
        local = hole_points(w[i], section, routing.a, routing.azimuths)
        for name, points in zip(routing.names, local @ rotations[i].T + origins[i], strict=True):
            lines.append(CableLine(name, i, colours[name], name not in section.cable_names, points))
    return lines


def curvature_arrows(w: Array, arm: Arm, metres_per_radian: float, longest_radius: float) -> list[Array | None]:
    """For each section the arrow of Allen's w = (u, v, 0), from the centre of curvature: start and end (2, 3) [m].

    Args:
        w: (n_sections, 2) [rad].
        arm: the arm.
        metres_per_radian: length of an arrow for each radian of bend.
        longest_radius: a section that is straighter than this radius of curvature [m] has no arrow: None.
    """
    rotations, origins = section_bases(w, arm)
    arrows: list[Array | None] = []
    for i, section in enumerate(arm.sections):
        arrow = section_arrow(w[i], section, metres_per_radian, longest_radius)
        arrows.append(None if arrow is None else arrow @ rotations[i].T + origins[i])
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
