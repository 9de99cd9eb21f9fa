"""Joint angles sample by sample: integrated rates, corrected by the accelerometers whenever a link rests."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.inertial.calibration_values import Calibration
from continuum.inertial.complementary_filter import ComplementaryFilter, Correction
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_sample import ImuSample, Truths
from continuum.inertial.inclination import inclination, of_neighbours, with_neighbour, within_half_a_turn
from continuum.inertial.integrated_rate import Liveliness, turn_since

_SAME_TIME = 1e-6  # s
_FEW = 3  # most missing readings that do not interrupt a rest


@dataclass(frozen=True)
class AngleEstimate:
    """The joints at one instant; values that are not good are NaN.

    Attributes:
        time: time of the sample [s].
        angles: (n,) [rad].
        rates: (n,) [rad/s]; from sensors that give means, those over the last period.
        good: joints whose angle is known, (n,).
        why_not: why a joint is not good, empty if it is, (n,).
        errors: estimated errors of the angles, half a turn or more if nothing is known, (n,) [rad].
        resting: links that are at rest, (n,).
    """

    time: float
    angles: Array
    rates: Array
    good: Truths
    why_not: tuple[str, ...]
    errors: Array
    resting: Truths


class AngleEstimator:
    """Estimator of one arm's joint angles; samples are given in the order of their times.

    Nothing is known at first: each link's angle is that of its first half second at rest.

    Args:
        calibration: calibration of the sensors.
        settings: what counts as rest, lost and good.

    Attributes:
        ignored: number of samples that were no later than the one before, and changed nothing.
    """

    def __init__(self, calibration: Calibration, settings: EstimatorSettings | None = None) -> None:
        self.calibration, self.settings = calibration, settings or EstimatorSettings()
        s, n = self.settings, calibration.n_sensors
        self._filter = ComplementaryFilter(s.time_constant, s.bias_time, s.inclination_error)
        self._window = max(3, round(s.rest_window / s.period))
        self._rates: deque[Array] = deque(maxlen=self._window)
        self._forces: deque[Array] = deque(maxlen=self._window)
        self._state = Correction(np.zeros(n), np.zeros(n), np.full(n, np.pi))
        self._lost = np.ones(n, dtype=bool)
        self._unbroken = np.zeros(n)  # readings since the last one that was missed or clipped
        self._run = np.zeros(n)  # readings since more than a few were missed, or one clipped
        self._count = np.zeros(n)  # readings at rest since the angle was lost
        self._received = np.full(n, -np.inf)
        self._rate_before, self._lively = np.zeros(n), Liveliness(np.zeros(n), np.zeros(n))
        self._last: AngleEstimate | None = None
        self.ignored = 0

    def update(self, sample: ImuSample) -> AngleEstimate:
        """Return the joints at the sample's time.

        Raises:
            InvalidValueError: another number of sensors than the calibration has.
        """
        if sample.n_sensors != self.calibration.n_sensors:
            raise InvalidValueError("number of sensors", sample.n_sensors, str(self.calibration.n_sensors))
        if self._last is not None and not sample.time > self._last.time + _SAME_TIME:
            self.ignored += 1
            return self._last
        since = self.settings.period if self._last is None else sample.time - self._last.time
        received = sample.usable()
        clipped = sample.clipped & received
        rates = np.where(received[:, None], sample.rates - self.calibration.bias, 0.0)
        rate = np.where(received, np.sum(self.calibration.axis * rates, axis=1) - self._state.drift, self._rate_before)
        self._integrate(sample.time, rate, received, clipped)
        resting = self._resting(rate, sample, received)
        self._correct(sample, resting, since)
        self._last = self._estimate(sample.time, rate, received, clipped, resting)
        return self._last

    def _integrate(self, time: float, rate: Array, received: Truths, clipped: Truths) -> None:
        s, state = self.settings, self._state
        known = received & np.isfinite(self._received)
        elapsed = np.where(known, time - np.where(known, self._received, time), 0.0)
        missing = np.where(known, np.maximum(np.round(elapsed / s.period) - 1, 0), 0.0)
        unsure = self._lively.error_of_gap(missing, rate - self._rate_before, s.period)
        angle = state.angle + turn_since(rate, self._rate_before, elapsed, s.period, s.rates_are_means)
        error = np.hypot(state.error, unsure) + s.bias_left * elapsed
        lost = clipped | (elapsed > s.longest_gap)  # the rate of a clipped sensor is unknown
        self._state = Correction(angle, state.drift, np.minimum(np.where(lost, np.pi, error), np.pi))
        self._received = np.where(received, time, self._received)
        self._rate_before = rate
        counts = received & ~clipped
        self._unbroken = np.where(counts, np.where(missing > 0, 1, self._unbroken + 1), 0)
        self._run = np.where(counts & (missing <= _FEW), self._run + 1, np.where(received, 0, self._run))

    def _resting(self, rate: Array, sample: ImuSample, received: Truths) -> Truths:
        """Return the links whose sensors were received without a gap and quiet over the whole window."""
        s = self.settings
        size = np.linalg.norm(sample.forces, axis=1) - self.calibration.gravity
        self._rates.append(rate)
        self._forces.append(np.where(received, np.abs(size), np.inf))
        rates = np.array(self._rates)
        if len(rates) >= 3:
            now = self._lively.after(rates[-3:], s.period, s.rest_window)
            known = self._unbroken >= 3
            self._lively = Liveliness(
                np.where(known, now.bend, self._lively.bend), np.where(known, now.step, self._lively.step)
            )
        whole = self._run >= self._window
        quiet = (
            (np.abs(rates).max(axis=0) <= s.rest_rate)
            & (rates.max(axis=0) - rates.min(axis=0) <= s.rest_rate_range)
            & (np.max(self._forces, axis=0) <= s.rest_force)
        )
        return np.asarray(whole & quiet)

    def _correct(self, sample: ImuSample, resting: Truths, since: float) -> None:
        s, calibration = self.settings, self.calibration
        self._lost |= self._state.error > s.largest_error
        self._count = np.where(resting, self._count + 1, np.where(self._lost, 0, self._count))
        forces = np.where(resting[:, None], sample.forces, calibration.zero)
        off = within_half_a_turn(inclination(forces, calibration.axis, calibration.zero) - self._state.angle)
        state = self._filter.corrected(self._state, off, since, np.where(resting, self._count, 0))
        found = self._lost & (self._count >= self._window / 2)
        self._lost &= ~found
        self._state = Correction(state.angle, state.drift, np.where(found, s.inclination_error, state.error))

    def _estimate(self, time: float, rate: Array, received: Truths, clipped: Truths, resting: Truths) -> AngleEstimate:
        errors = with_neighbour(self._state.error)
        why = [self._why_not(i, bool(received[i]), bool(clipped[i])) for i in range(received.size)]
        problems = tuple(
            own or before or ("" if error <= self.settings.largest_error else f"known to {np.degrees(error):.1f} deg")
            for own, before, error in zip(why, ["", *why], errors, strict=False)
        )
        good = np.array([not text for text in problems])
        angles = within_half_a_turn(of_neighbours(self._state.angle))
        return AngleEstimate(
            time,
            np.where(good, angles, np.nan),
            np.where(good, of_neighbours(rate), np.nan),
            good,
            problems,
            errors,
            resting,
        )

    def _why_not(self, sensor: int, received: bool, clipped: bool) -> str:
        if not received:
            return f"sensor {sensor + 1} is missing"
        if clipped:
            return f"sensor {sensor + 1} is clipped"
        if self._lost[sensor]:
            return f"sensor {sensor + 1} waits for rest"
        return ""
