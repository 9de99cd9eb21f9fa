"""A random linear run for the augmented filter, and the same run as one large Gaussian vector, by brute force."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
import scipy.linalg

from continuum.estimation.augmented_filter import Measurement
from continuum.estimation.run import Run, Trajectory
from continuum.estimation.sensor_noise import NoiseModel
from continuum.estimation.transition import Transition

COLUMNS = 3


def random_covariance(random: np.random.Generator, size: int, rank: int | None = None) -> np.ndarray:
    """A covariance of some rank, full without."""
    factor = random.normal(0, 1, (size, size if rank is None else rank))
    return factor @ factor.T


@dataclass(frozen=True)
class LinearRun:
    """All that the filter is given, numbers that belong to no arm.

    Attributes:
        run, way, step, seen, noise: as `run_likelihood` takes them.
        columns: of states (n_times - 1, 2 n, COLUMNS), and of readings (n_times, n_readings, COLUMNS).
    """

    run: Run
    way: Trajectory
    step: Transition
    seen: Measurement
    noise: NoiseModel
    columns: tuple[np.ndarray, np.ndarray]

    @classmethod
    def drawn(cls, seed: int, n: int = 2, with_rates: bool = True, rows: int = 9) -> Self:
        """Rows at uneven times; process noise that does not reach every direction."""
        random = np.random.default_rng(seed)
        size, n2, m = n * (1 + with_rates), 2 * n, rows - 1
        times = random.uniform(-1, 1) + np.cumsum(random.uniform(0.003, 0.03, rows))
        readings, live = random.normal(0, 1, (rows, size)), np.ones((rows, size))
        run = Run("random", times, readings, live, n, (np.zeros(1), np.zeros((1, 2))))
        way = Trajectory(*(random.normal(0, 0.5, (rows, n)) for _ in range(4)))
        F = np.eye(n2) + random.normal(0, 0.2, (m, n2, n2))
        noise = np.stack([0.05 * random_covariance(random, n2, n) for _ in range(m)])
        none = np.zeros((int(run.first[-1]), n))
        W = np.zeros((int(run.first[-1]), n2, n))
        D = random.normal(0, 0.3, (m, n2, n))
        step = Transition(random.normal(0, 0.5, (m, n2)), F, D, W, noise, none, none)
        seen = Measurement(random.normal(0, 0.5, (rows, size)), random.normal(0, 1, (size, n2)))
        stochastic = NoiseModel(
            0.1 * random_covariance(random, size) + 0.05 * np.eye(size), random.uniform(0.05, 0.5, n),
            random.uniform(0.1, 1.0, n), random.uniform(0.01, 0.3), random.uniform(0.01, 0.1),
            random.uniform(0.2, 1.0), random.uniform(0.2, 1.0),
        )  # fmt: skip
        columns = random.normal(0, 1, (m, n2, COLUMNS)), random.normal(0, 1, (rows, size, COLUMNS))
        return cls(run, way, step, seen, stochastic, columns)

    def with_unmeasured(self, seed: int, share: float, stand_in: float) -> Self:
        """The same run where some readings were not measured, and a number stands in their place."""
        measured = np.random.default_rng(seed).uniform(size=self.run.live.shape) > share
        readings = np.where(measured, self.run.readings, stand_in)
        return replace(self, run=replace(self.run, live=measured.astype(float), readings=readings))

    def added(self, theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Sum of the columns at coefficients theta."""
        return self.columns[0] @ theta, self.columns[1] @ theta


class Dense:
    """Every state and every reading of a run at once: their joint Gaussian distribution at coefficients theta."""

    def __init__(self, given: LinearRun, theta: np.ndarray) -> None:
        run, way, step, noise, n = given.run, given.way, given.step, given.noise, given.run.n
        n4, rows, size = 4 * n, *run.readings.shape
        of_states, of_readings = given.added(theta)
        sd = np.concatenate([np.full(n, noise.start_angle), np.full(n, noise.start_rate), noise.slow, noise.sigma])
        chain, driven, input_covariance = np.eye(rows * n4), np.zeros(rows * n4), [np.diag(sd**2)]
        for k, h in enumerate(run.intervals):
            kept_b, kept_d = np.exp(-h / noise.slow_time), np.exp(-h / noise.torque_time)
            on, to = slice(k * n4, (k + 1) * n4), slice((k + 1) * n4, (k + 2) * n4)
            move = scipy.linalg.block_diag(step.F[k], kept_b * np.eye(n), kept_d * np.eye(n))
            move[: 2 * n, 3 * n :] = step.D[k]
            chain[to, on] = -move
            reached = step.end[k] - step.D[k] @ way.d[k] + of_states[k]
            driven[to][: 2 * n] = reached - np.concatenate([way.q[k + 1], way.w[k + 1]])
            fresh = (noise.slow**2 * (1 - kept_b**2), noise.sigma**2 * (1 - kept_d**2))
            input_covariance.append(scipy.linalg.block_diag(step.noise[k], *map(np.diag, fresh)))
        inverse = np.linalg.inv(chain)
        self._mean, self._covariance = (
            inverse @ driven,
            inverse @ scipy.linalg.block_diag(*input_covariance) @ inverse.T,
        )
        one = np.hstack([given.seen.H, np.eye(size, n), np.zeros((size, n))])
        measured = run.live.ravel() > 0
        self._C = np.kron(np.eye(rows), one)[measured]
        white = np.kron(np.eye(rows), noise.white)[np.ix_(measured, measured)]
        self._S = self._C @ self._covariance @ self._C.T + white
        expected = (given.seen.expected + of_readings).ravel()[measured] + self._C @ self._mean
        self._missed = run.readings.ravel()[measured] - expected
        self._shape = rows, n4

    @property
    def energy(self) -> float:
        """Missed readings by the inverse of their covariance."""
        return float(self._missed @ np.linalg.solve(self._S, self._missed))

    @property
    def log_det(self) -> float:
        """Of the readings' covariance."""
        return float(np.linalg.slogdet(self._S)[1])

    def states(self) -> tuple[np.ndarray, np.ndarray]:
        """Means and variances of all states given all readings, (rows, 4 n) each."""
        gain = np.linalg.solve(self._S, self._C @ self._covariance).T
        left = self._covariance - gain @ self._C @ self._covariance
        return (self._mean + gain @ self._missed).reshape(self._shape), np.diag(left).reshape(self._shape)
