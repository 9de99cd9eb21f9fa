"""Cables between the holes of the discs that they run through, wherever the links are."""

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

    They are the lines of `continuum.kinematics.cable_lines`, but of the links' poses, which the page has anyway, and in
    arrays as it draws them.

    Args:
        arm: the arm.
        links: names of its description's links.
        passing: the cables where they pass a section on their way to another further out; else where they are
            the section's own.

    Attributes:
        cables: name of the cable that each piece belongs to, (n_pieces,).
        colours: of both ends of each piece, (n_pieces, 2, 3), from 0 to 1.
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
        """Both ends of each piece, (..., n_pieces, 2, 3) [m], at the links' ``poses`` (..., n_links, 4, 4)."""
        frames = poses[..., self._links, :, :]
        held = np.einsum("...pekl,pl->...pek", frames[..., :3, :3], self._places)
        ends: Array = held + frames[..., :3, 3]
        return ends
