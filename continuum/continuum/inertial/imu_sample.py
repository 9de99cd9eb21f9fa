"""One synchronised instant of all inertial sensors of an arm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.errors import InvalidValueError

Truths = NDArray[np.bool_]

_RATE, _FORCE = 1e3, 1e4  # rad/s, m/s2: no sensor goes so far


@dataclass(frozen=True)
class ImuSample:
    """What the sensors read, in each one's own axes; the first sits on the link nearest to the base.

    Attributes:
        time: of the reading, by a clock without jitter [s].
        rates: angular rates, (n, 3) [rad/s].
        forces: specific forces, that is acceleration less gravity, (n, 3) [m/s2]; a sensor at rest reads 9.81 upwards.
        clipped: a sensor that was at the end of its range, (n,).
        valid: a sensor that was heard, (n,); what the others have in ``rates`` and ``forces`` is not looked at.
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
        """How many sensors there are."""
        return int(self.valid.size)

    def usable(self) -> Truths:
        """Sensors that were heard and gave numbers that a sensor can give, (n,)."""
        possible = np.all(np.abs(self.rates) < _RATE, axis=1) & np.all(np.abs(self.forces) < _FORCE, axis=1)
        return np.asarray(self.valid & possible)
