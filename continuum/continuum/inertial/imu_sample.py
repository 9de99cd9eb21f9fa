"""One synchronised instant of all inertial sensors of an arm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.errors import InvalidValueError

Truths = NDArray[np.bool_]

_RATE, _FORCE = 1e3, 1e4  # rad/s, m/s2: beyond the range of any sensor


@dataclass(frozen=True)
class ImuSample:
    """Readings of the sensors, each in its own axes; the first sensor is on the link next to the base.

    Attributes:
        time: time of the reading, by a clock without jitter [s].
        rates: angular rates, (n, 3) [rad/s].
        forces: specific forces, i.e. acceleration minus gravity, (n, 3) [m/s2]; a sensor at rest reads 9.81 upwards.
        clipped: whether a sensor was at the end of its range, (n,).
        valid: whether a sensor was received, (n,); ``rates`` and ``forces`` of the others are ignored.
    """

    time: float
    rates: Array
    forces: Array
    clipped: Truths
    valid: Truths

    def __post_init__(self) -> None:
        n = self.valid.size
        for name, given, shape in (
            ("rates", self.rates, (n, 3)),
            ("forces", self.forces, (n, 3)),
            ("clipped", self.clipped, (n,)),
        ):
            if given.shape != shape:
                raise InvalidValueError(f"shape of {name}", given.shape, str(shape))

    @property
    def n_sensors(self) -> int:
        """Number of sensors."""
        return int(self.valid.size)

    def usable(self) -> Truths:
        """Return the sensors that were received with possible values, (n,)."""
        possible = np.all(np.abs(self.rates) < _RATE, axis=1) & np.all(np.abs(self.forces) < _FORCE, axis=1)
        return np.asarray(self.valid & possible)
