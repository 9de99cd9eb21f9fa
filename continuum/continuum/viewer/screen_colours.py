"""Colours in the formats of the renderer and of the plots, adapted to dark pages."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from continuum.arrays import Array
from continuum.cable_colours import Colour

_GAMMA = 2.2

_DARKEST = 0.25
"""Smallest maximum of red, green and blue at which a colour is visible on a dark page."""


def linear_light(colours: ArrayLike) -> NDArray[np.uint8]:
    """Return screen colours (..., 3) from 0 to 1 as linear light from 0 to 255."""
    light: NDArray[np.uint8] = np.round(255 * np.asarray(colours, dtype=float) ** _GAMMA).astype(np.uint8)
    return light


def seen_on_dark(colours: ArrayLike) -> Array:
    """Return colours (..., 3) from 0 to 1 with nearly black ones inverted."""
    given = np.asarray(colours, dtype=float)
    return np.where(given.max(axis=-1, keepdims=True) < _DARKEST, 1.0 - given, given)


def css(colour: Colour, dark: bool = False) -> str:
    """Return the CSS notation of a colour, adapted to a dark or a light page."""
    shown = seen_on_dark(colour).tolist() if dark else colour
    return "rgb({:.0f}, {:.0f}, {:.0f})".format(*(255 * part for part in shown))
