"""Actuators and load cells of the cables: a first-order lag behind the set points, and measurement noise."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.live.stepper import Interval


class Actuators:
    """Actuators and load cells; the cables are initially slack.

    Args:
        n_cables: number of cables.
        lag: time constant [s]; 0 for none.
        noise: standard deviation of the load cells [N].
        random: generator of the noise.

    Attributes:
        tension: current tension, (n_cables,) [N].
    """

    def __init__(self, n_cables: int, lag: float, noise: float, random: np.random.Generator) -> None:
        self.tension = np.zeros(n_cables)
        self._lag, self._noise, self._random = lag, noise, random

    def follow(self, wanted: Interval) -> Interval:
        """Return the tensions while the set points change as ``wanted``."""
        before = self.tension
        share = 1.0 if self._lag <= 0.0 else -np.expm1(-wanted.duration / self._lag)
        self.tension = before + share * (wanted.after - before)
        return Interval(wanted.duration, before, self.tension)

    def measured(self) -> Array:
        """Return the current readings of the load cells, (n_cables,) [N]."""
        return np.asarray(self.tension + self._random.normal(0.0, self._noise, self.tension.shape))
