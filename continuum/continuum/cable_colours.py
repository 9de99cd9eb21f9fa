"""Colours of cables, the same in pictures, in RViz and in the browser."""

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
    """Of cable ``number`` of a section, from 0: blue, green, red, black as in the thesis's Fig. 14, then others."""
    return _COLOURS[number % len(_COLOURS)]
