"""Colours as the page takes them: for its renderer, for its plots, and so that they are seen on a dark page."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from continuum.arrays import Array
from continuum.cable_colours import Colour

_GAMMA = 2.2

_DARKEST = 0.25
"""Largest of red, green and blue below which a colour is not seen on a dark page."""


def linear_light(colours: ArrayLike) -> NDArray[np.uint8]:
    """Colours (..., 3) from 0 to 1, as a screen shows them, in shares of light from 0 to 255."""
    light: NDArray[np.uint8] = np.round(255 * np.asarray(colours, dtype=float) ** _GAMMA).astype(np.uint8)
    return light


def seen_on_dark(colours: ArrayLike) -> Array:
    """Return colours (..., 3) from 0 to 1, of which those that are nearly black are light instead."""
    given = np.asarray(colours, dtype=float)
    return np.where(given.max(axis=-1, keepdims=True) < _DARKEST, 1.0 - given, given)


def css(colour: Colour, dark: bool = False) -> str:
    """Return a colour for style sheets, as it is seen on a dark or a light page."""
    shown = seen_on_dark(colour).tolist() if dark else colour
    return "rgb({:.0f}, {:.0f}, {:.0f})".format(*(255 * part for part in shown))
