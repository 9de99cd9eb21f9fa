"""Models that data cannot tell from the fitted one: drawn from what its Fisher information leaves open."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from continuum.dynamics.model import Model
from continuum.dynamics.values import with_vector
from continuum.identification.fit import Fit


def drawn_models(fitted: Fit, random: np.random.Generator, count: int) -> Iterator[Model]:
    """So many of them, within the bounds of the unknowns.

    Args:
        fitted: a fit.
        random: where the draws come from.
        count: how many.
    """
    root = np.linalg.cholesky(np.linalg.inv(fitted.information))
    for _ in range(count):
        coordinates = fitted.space.clipped(fitted.coordinates + root @ random.normal(size=root.shape[0]))
        yield with_vector(fitted.simulator.model, fitted.space.common_values(coordinates))
