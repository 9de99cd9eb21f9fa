"""Colours of compared motions, the same in the scene and in plots."""

from __future__ import annotations

from continuum.cable_colours import Colour

SOLID: Colour = (0.95, 0.45, 0.10)
"""Colour of the motion that is drawn solid; its tip path has the same colour."""

GHOST: Colour = (0.27, 0.51, 0.78)

_OVERLAYS: tuple[Colour, ...] = ((0.18, 0.60, 0.32), (0.60, 0.30, 0.75), (0.80, 0.20, 0.35), (0.00, 0.60, 0.62))


def overlay_colour(number: int) -> Colour:
    """Return the colour of overlay ``number``, from 0."""
    return _OVERLAYS[number % len(_OVERLAYS)]
