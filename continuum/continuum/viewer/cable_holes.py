"""Cables as straight pieces between the holes of the discs, for any poses of the links."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.cable_colours import cable_colour
from continuum.kinematics.routing import cables_through


class CableHoles:
    """Straight pieces of cables from disc to disc.

    They are the lines of `continuum.kinematics.cable_lines`, but computed from the poses of the links, which the page
    has anyway, and returned in the arrays that it draws.

    Args:
        arm: arm.
        links: names of the links of its description.
        passing: whether to return the cables where they pass through a section to one further out; otherwise, where
            they end in the section.

    Attributes:
        cables: name of the cable of each piece, (n_pieces,).
        colours: colours of both ends of each piece, (n_pieces, 2, 3), from 0 to 1.
    """

    def __init__(self, arm: Arm, links: Sequence[str], passing: bool) -> None:
        number = {link: i for i, link in enumerate(links)}
        on: list[tuple[int, int]] = []
        places: list[tuple[float, float, float]] = []
        colours: list[tuple[float, float, float]] = []
        cables: list[str] = []
        colour_of = {name: cable_colour(j) for section in arm.sections for j, name in enumerate(section.cable_names)}
        for i, section in enumerate(arm.sections):
            discs = [number[link] for link in section.disc_frames]
            routing = cables_through(arm, i)
            for name, a, azimuth in zip(routing.names, routing.a, routing.azimuths, strict=True):
                if (name not in section.cable_names) is passing:
                    on += pairwise(discs)
                    places += [(a * np.cos(azimuth), a * np.sin(azimuth), 0.0)] * section.n_joints
                    cables += [name] * section.n_joints
                    colours += [colour_of[name]] * section.n_joints
        self.cables = np.array(cables)
        self._links = np.array(on, dtype=int).reshape(-1, 2)
        self._places = np.array(places).reshape(-1, 3)
        self.colours = np.repeat(np.array(colours).reshape(-1, 1, 3), 2, axis=1)

    def pieces(self, poses: Array) -> Array:
        """Return both ends of each piece, (..., n_pieces, 2, 3) [m], at link ``poses``, (..., n_links, 4, 4) [m]."""
        frames = poses[..., self._links, :, :]
        held = np.einsum("...pekl,pl->...pek", frames[..., :3, :3], self._places)
        ends: Array = held + frames[..., :3, 3]
        return ends
