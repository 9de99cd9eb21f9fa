"""Of all unknowns that mean the same arm those that the prior likes best.

A stiffer spring of one joint may be that joint's part of its batch, or an effect at that joint, or the spring of all
joints with every other one weaker: no simulation tells, only what is known of parts does. A damped search comes to the
arm that fits and stays where it happens to have come to it, standard deviations off; from there this goes on, without
simulations.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.dynamics.felt_values import felt_values
from continuum.dynamics.model import Model
from continuum.dynamics.values import with_vector
from continuum.identification.free import FreeSpace

_NUDGE = 1e-5  # of a coordinate's spread
_SAME = 1e-9  # of an unknown's effect by one spread
_RANK = 1e-6
_STEPS, _LONGEST = 50, 0.3  # of a spread


def likeliest(space: FreeSpace, model: Model, coordinates: Array) -> Array:
    """Coordinates (k,) within the bounds that mean the same as those given.

    What belongs to one recording stays, as does what would leave its bounds; all stays where no such place is found.

    Args:
        space: the unknowns.
        model: that they are unknowns of.
        coordinates: of them, (k,).
    """
    moves = np.array([unknown.recording is None for unknown in space.unknowns])
    while np.any(moves):
        found = _least_prior(space, model, coordinates, np.flatnonzero(moves))
        if found is None:
            break
        beyond = moves & ((found < space.lower) | (found > space.upper))
        if not np.any(beyond):
            return found
        moves &= ~beyond
    return coordinates


def _least_prior(space: FreeSpace, model: Model, coordinates: Array, moves: NDArray[np.intp]) -> Array | None:
    """Least squares of the prior under the condition that what the arm feels stays, by Gauss and Newton.

    Each step goes to the least of all that the slopes there say to be the same.
    """
    spread, at = space.spread[moves], coordinates.copy()

    def felt(z: Array) -> Array:
        there = at.copy()
        there[moves] = spread * z
        return felt_values(with_vector(model, space.origin + space.directions_of(-1) @ there))

    z = coordinates[moves] / spread
    wanted = felt(z)
    for _ in range(_STEPS):
        slopes = np.stack([felt(z + _NUDGE * e) - felt(z - _NUDGE * e) for e in np.eye(z.size)], axis=1) / (2 * _NUDGE)
        size = np.linalg.norm(slopes, axis=1)
        felt_at_all = size > 0
        slopes, unit = slopes[felt_at_all] / size[felt_at_all, None], size[felt_at_all]
        off = (wanted - felt(z))[felt_at_all] / unit
        new = np.linalg.pinv(slopes, rcond=_RANK) @ (slopes @ z + off)
        if np.max(np.abs(new - z), initial=0.0) < _SAME and np.max(np.abs(off), initial=0.0) < _SAME:
            at[moves] = spread * new
            return at
        step = new - z
        z = z + step / max(1.0, np.max(np.abs(step)) / _LONGEST)
    return None
