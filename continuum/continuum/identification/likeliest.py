"""Of all unknowns that mean the same arm those that the prior likes best.

A stiffer spring of one joint may be that joint's part of its batch, or an effect at that joint, or the spring of all
joints with every other one weaker: no simulation tells, only what is known of parts does. A damped search comes to the
arm that fits and stays where it happens to have come to it, standard deviations off; from there this goes on, without
simulations.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.felt_values import felt_values
from continuum.dynamics.model import Model
from continuum.dynamics.values import with_vector
from continuum.identification.free import FreeSpace

_NUDGE = 1e-5  # of a coordinate's spread
_SAME = 1e-8  # of an unknown's effect by one spread
_RANK = 1e-6
_STEPS, _LONGEST = 50, 0.3  # of a spread


def likeliest(space: FreeSpace, model: Model, coordinates: Array) -> Array:
    """Coordinates (k,) within the bounds that mean the same as those given.

    Least squares of the prior under the condition that what the arm feels stays, by Gauss and Newton: each step goes
    towards the least of all that the slopes there say to be the same. What belongs to one recording stays; all stays
    where no such place is found.

    Args:
        space: the unknowns.
        model: that they are unknowns of.
        coordinates: of them, (k,).
    """
    moves = np.flatnonzero([unknown.recording is None for unknown in space.unknowns])
    spread, at, directions = space.spread[moves], coordinates.copy(), space.directions_of(-1)
    lower, upper = space.lower[moves] / spread, space.upper[moves] / spread

    def felt(z: Array) -> Array:
        at[moves] = spread * z
        return felt_values(with_vector(model, space.origin + directions @ at))

    z = np.clip(coordinates[moves] / spread, lower, upper)
    wanted = felt(coordinates[moves] / spread)
    for _ in range(_STEPS):
        slopes = _slopes(felt, z, lower, upper)
        off = wanted - felt(z)
        if not np.all(np.isfinite(slopes)):
            break
        size = np.linalg.norm(slopes, axis=1)
        unit = np.where(size > 0, size, 1.0)
        new = _least(slopes / unit[:, None], (slopes @ z + off) / unit, lower, upper)
        if np.max(np.abs(new - z), initial=0.0) < _SAME and np.max(np.abs(off / unit), initial=0.0) < _SAME:
            at[moves] = spread * new
            return at
        step = new - z
        z = z + step / max(1.0, np.max(np.abs(step), initial=0.0) / _LONGEST)
    return coordinates


def _slopes(felt: Callable[[Array], Array], z: Array, lower: Array, upper: Array) -> Array:
    """Slopes of what is felt, (m, k), from values within the bounds."""
    columns = []
    for unit in np.eye(z.size):
        more, less = np.minimum(z + _NUDGE * unit, upper), np.maximum(z - _NUDGE * unit, lower)
        width = float(unit @ (more - less))
        columns.append((felt(more) - felt(less)) / width if width > 0 else 0 * felt(z))
    return np.stack(columns, axis=1)


def _least(slopes: Array, value: Array, lower: Array, upper: Array) -> Array:
    """The smallest z (k,) within the bounds of those with ``slopes z = value``, as nearly as there are any.

    Of all that would leave its bounds the one that is farthest out is put on its bound, and the rest sought again.
    """
    z, free = np.zeros(lower.size), np.ones(lower.size, dtype=bool)
    while np.any(free):
        z[free] = np.linalg.pinv(slopes[:, free], rcond=_RANK) @ (value - slopes[:, ~free] @ z[~free])
        beyond = np.where(free, np.maximum(lower - z, z - upper), 0.0)
        worst = int(np.argmax(beyond))
        if beyond[worst] <= 0:
            break
        z[worst] = np.clip(z[worst], lower[worst], upper[worst])
        free[worst] = False
    return z
