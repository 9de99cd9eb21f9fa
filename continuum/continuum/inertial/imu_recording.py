"""Samples of all sensors over time, as arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.inertial.imu_sample import ImuSample, Truths


@dataclass(frozen=True)
class ImuRecording:
    """Readings at increasing times; the sensors count from the base.

    Attributes:
        times: (n_times,) [s].
        rates: angular rates in each sensor's axes, (n_times, n, 3) [rad/s].
        forces: specific forces likewise, (n_times, n, 3) [m/s2].
        clipped, valid: flags as in `ImuSample`, (n_times, n).
    """

    times: Array
    rates: Array
    forces: Array
    clipped: Truths
    valid: Truths

    @classmethod
    def of(cls, samples: Sequence[ImuSample]) -> ImuRecording:
        """Return a recording of successive samples.

        Raises:
            InvalidValueError: no samples, or samples with different numbers of sensors.
        """
        if len({sample.n_sensors for sample in samples}) != 1:
            raise InvalidValueError("samples", len(samples), "at least one, all of the same number of sensors")
        return cls(
            np.array([sample.time for sample in samples]),
            np.stack([sample.rates for sample in samples]),
            np.stack([sample.forces for sample in samples]),
            np.stack([sample.clipped for sample in samples]),
            np.stack([sample.valid for sample in samples]),
        )

    @property
    def n_sensors(self) -> int:
        """Number of sensors."""
        return int(self.valid.shape[1])

    @property
    def good(self) -> Truths:
        """Readings that were received and not clipped, (n_times, n)."""
        return np.asarray(self.valid & ~self.clipped)

    def part(self, begin: float, end: float) -> ImuRecording:
        """Return the part between two times, both included [s]."""
        rows = (self.times >= begin) & (self.times <= end)
        return ImuRecording(self.times[rows], self.rates[rows], self.forces[rows], self.clipped[rows], self.valid[rows])

    def samples(self) -> Iterator[ImuSample]:
        """Yield the samples one after another."""
        for row in zip(self.times, self.rates, self.forces, self.clipped, self.valid, strict=True):
            yield ImuSample(float(row[0]), *row[1:])
