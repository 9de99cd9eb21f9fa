"""Colours as the page's renderer takes them where each point or instance has its own."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

_GAMMA = 2.2


def linear_light(colours: ArrayLike) -> NDArray[np.uint8]:
    """Colours (..., 3) from 0 to 1, as a screen shows them, in shares of light from 0 to 255."""
    light: NDArray[np.uint8] = np.round(255 * np.asarray(colours, dtype=float) ** _GAMMA).astype(np.uint8)
    return light
