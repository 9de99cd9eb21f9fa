"""One recording as the filter uses it: rows of readings, inputs between them, and the trajectory known so far."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.estimation.effect_states import SubstepMotion

_SUBSTEP = 4.2e-3  # s, longest substep: accelerations of the links change little in it, whatever the sampling


@dataclass(frozen=True)
class Trajectory:
    """Smoothed states at the samples, (n_times, n) each.

    Attributes:
        q, w: joint angles and rates [rad, rad/s].
        b: slow error of the angles' sensors [rad].
        d: missing torque [N m].
    """

    q: Array
    w: Array
    b: Array
    d: Array

    def moved(self, by: Array) -> Trajectory:
        """Return the trajectory plus smoothed deviations of q and w, with new values of b and d, (n_times, 4 n)."""
        n = self.q.shape[1]
        return Trajectory(self.q + by[:, :n], self.w + by[:, n : 2 * n], by[:, 2 * n : 3 * n], by[:, 3 * n :])


@dataclass(frozen=True)
class Run:
    """A recording's rows.

    Attributes:
        name: name of the recording.
        times: times of the rows, (n_times,) [s].
        readings: angles, then rates if used, (n_times, n or 2 n) [rad, rad/s].
        live: which of them were measured, in the same shape.
        n: number of joints.
        signal: times (breaks,) [s] and values (breaks, n_inputs) [N or N m] of the inputs.
        held: whether a value holds until the next one; otherwise inputs are linear between values.
    """

    name: str
    times: Array
    readings: Array
    live: Array
    n: int
    signal: tuple[Array, Array] = field(repr=False)
    held: bool = True

    @property
    def has_rates(self) -> bool:
        """Whether rates are among the readings."""
        return bool(self.readings.shape[1] > self.n)

    @cached_property
    def intervals(self) -> Array:
        """Length of each interval between rows, (n_times - 1,) [s]."""
        return np.diff(self.times)

    @cached_property
    def first(self) -> NDArray[np.int64]:
        """First substep of each interval, and the number of substeps, (n_times,)."""
        return substeps(self.times)

    @cached_property
    def length(self) -> Array:
        """Length of each substep, (rows,) [s]."""
        counts = np.diff(self.first)
        return np.repeat(self.intervals / counts, counts)

    def first_guess(self) -> Trajectory:
        """Estimate angles and rates by local parabolas over five rows; take rates as measured if they are."""
        n, half = len(self.times), 2
        q, w = np.empty((n, self.n)), np.empty((n, self.n))
        for k in range(n):
            a = min(max(k - half, 0), max(n - 2 * half - 1, 0))
            since = self.times[a : a + 2 * half + 1] - self.times[k]
            fit = np.linalg.lstsq(np.vander(since, 3), self.readings[a : a + since.size, : self.n], rcond=None)[0]
            q[k], w[k] = fit[2], fit[1]
        if self.has_rates:
            w = self.readings[:, self.n :].copy()
        return Trajectory(q, w, np.zeros_like(q), np.zeros_like(q))

    def between(self, way: Trajectory) -> tuple[Array, Array]:
        """Interpolate angles by cubic Hermite polynomials and rates linearly, (rows, n) each [rad, rad/s].

        The rows are the middles of the substeps.
        """
        counts = np.diff(self.first)
        k = np.repeat(np.arange(len(counts)), counts)
        share = (np.arange(self.first[-1]) - self.first[k] + 0.5) / counts[k]
        s, h = share[:, None], self.intervals[k][:, None]
        q0, q1, w0, w1 = way.q[k], way.q[k + 1], way.w[k], way.w[k + 1]
        q = (1 + 2 * s) * (1 - s) ** 2 * q0 + s**2 * (3 - 2 * s) * q1 + h * s * (1 - s) * ((1 - s) * w0 - s * w1)
        w = w0 + s * (w1 - w0)
        return q, w

    @cached_property
    def inputs(self) -> Array:
        """Inputs in each substep, (rows, n_inputs) [N or N m]."""
        return self.inputs_later(0.0)

    def inputs_later(self, delay: float) -> Array:
        """Return the mean inputs in each substep with a ``delay`` [s], (rows, n_inputs) [N or N m]."""
        times, values = self.signal
        middle = substep_times(self.times) - delay
        if len(times) == 1:
            return np.repeat(values, len(middle), axis=0)
        return np.stack([self._mean(times, column, middle) for column in values.T], axis=1)

    def _mean(self, times: Array, values: Array, middle: Array) -> Array:
        """Return the mean of one input over each substep, exact for held and linear inputs, (rows,)."""
        steps = np.diff(times) * (values[:-1] if self.held else (values[:-1] + values[1:]) / 2)
        total = np.concatenate([[0.0], np.cumsum(steps)])
        low, high = (self._integral(times, values, total, middle + sign * self.length / 2) for sign in (-1, 1))
        return (high - low) / self.length

    def _integral(self, times: Array, values: Array, total: Array, t: Array) -> Array:
        k = np.clip(np.searchsorted(times, t, side="right") - 1, 0, len(times) - 2)
        since = t - times[k]
        if self.held:
            rate = np.where(t < times[0], values[0], np.where(t >= times[-1], values[-1], values[k]))
            base = np.where(t >= times[-1], total[-1], total[k])
            since = np.where(t >= times[-1], t - times[-1], since)
            return np.asarray(base + rate * since)
        rate = np.diff(values)[k] / np.diff(times)[k]
        inside = total[k] + values[k] * since + rate * since**2 / 2
        before, after = values[0] * (t - times[0]), total[-1] + values[-1] * (t - times[-1])
        return np.asarray(np.where(t < times[0], before, np.where(t > times[-1], after, inside)))

    def with_held(self, held: bool) -> Run:
        """Return the run with its inputs held, or linear between their values."""
        return replace(self, held=held)


def substeps(times: Array) -> NDArray[np.int64]:
    """Return the first substep of each interval, and the number of substeps, (n_times,)."""
    counts = np.maximum(np.ceil(np.diff(times) / _SUBSTEP - 1e-6), 1).astype(np.int64)
    return np.concatenate([[0], np.cumsum(counts)])


def substep_times(times: Array) -> Array:
    """Return the middle of each substep, (rows,) [s]."""
    counts = np.diff(substeps(times))
    k = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(k)) - substeps(times)[k]
    return np.asarray(times[k] + (within + 0.5) / counts[k] * np.diff(times)[k])


def substep_motion(run: Run, way: Trajectory, slip: Array, acceleration: Array) -> SubstepMotion:
    """Return the motion along which effects and derivatives are evaluated."""
    q, w = run.between(way)
    return SubstepMotion(np.stack([q, w, acceleration], axis=1), slip, run.inputs, run.length)
