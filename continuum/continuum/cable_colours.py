"""Colours of the cables in pictures, in RViz and in the browser."""

from __future__ import annotations

Colour = tuple[float, float, float]
"""Red, green and blue from 0 to 1."""

_COLOURS: tuple[Colour, ...] = (
    (0.12, 0.31, 0.85),
    (0.10, 0.56, 0.24),
    (0.82, 0.13, 0.13),
    (0.13, 0.13, 0.13),
    (0.69, 0.47, 0.00),
    (0.48, 0.18, 0.69),
    (0.00, 0.56, 0.63),
    (0.75, 0.25, 0.50),
)


def cable_colour(number: int) -> Colour:
    """Return the colour of cable ``number`` of a section, from 0; the first four are those of thesis Fig. 14."""
    return _COLOURS[number % len(_COLOURS)]
